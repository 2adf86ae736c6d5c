#include "glare/ugr_table.hpp"

#include <algorithm>
#include <cmath>

#include "glare/luminous_area.hpp"
#include "glare/ugr.hpp"

namespace dim {
namespace {

constexpr double kHeight_m = 2.0;  // cancels out but for small sources
constexpr int kGammas = 360, kPlanes = 180;

/// A luminaire hung for the table: the room's x is across the line of sight, y along it, the aim down.
struct Hung {
  Vec3 c0, c90;

  static Hung with(bool c0_along_sight) {
    const Vec3 c0 = c0_along_sight ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    return {c0, glm::cross(c0, Vec3(0, 0, -1))};
  }
  Vec3 local(const Vec3& d) const { return {glm::dot(d, c0), glm::dot(d, c90), -d.z}; }
};

struct Fluxes {
  double down_lm = 0.0, up_lm = 0.0;
  double floor_lm = 0.0;  ///< of a luminaire of a room, on the plane of the eye
};

// Of luminaires spread evenly over the ceiling, the share (1 - |dx|/X) (1 - |dy|/Y) sends a ray onto the
// floor that falls dx, dy aside.
Fluxes fluxes(const IntensityTable& intensity, const Hung& hung, const UgrRoom& room) {
  Fluxes flux;
  const double step_gamma = kPi / kGammas, step_c = 2.0 * kPi / kPlanes;
  for (int g = 0; g < kGammas; ++g) {
    const double gamma = (g + 0.5) * step_gamma;
    const double solid_angle_sr = step_c * (std::cos(g * step_gamma) - std::cos((g + 1) * step_gamma));
    for (int c = 0; c < kPlanes; ++c) {
      const double turn = (c + 0.5) * step_c, across = std::sin(gamma);
      const Vec3 d(across * std::cos(turn), across * std::sin(turn), -std::cos(gamma));
      const double lm = intensity.at(hung.local(d)) * solid_angle_sr;
      if (d.z >= 0.0) {
        flux.up_lm += lm;
        continue;
      }
      flux.down_lm += lm;
      flux.floor_lm += lm * std::max(0.0, 1.0 + std::abs(d.x) / d.z / room.x_h) *
                       std::max(0.0, 1.0 + std::abs(d.y) / d.z / room.y_h);
    }
  }
  return flux;
}

// Between equal rectangles opposite each other, sides a and b times their distance (Hottel).
double opposite_view_factor(double a, double b) {
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  return 2.0 / (kPi * a * b) *
         (std::log(p * q / std::sqrt(1.0 + a * a + b * b)) + a * q * std::atan(a / q) +
          b * p * std::atan(b / p) - a * std::atan(a) - b * std::atan(b));
}

/// Indirect illuminance of the walls, lx, from lm on each square metre of the ceiling's area, H = 1.
double indirect_wall_lx(const UgrRoom& room, const UgrReflectances& rho, double ceiling_lm, double floor_lm,
                        double walls_lm) {
  const double x = room.x_h, y = room.y_h, walls_per_floor = 2.0 * (x + y) / (x * y);
  const double f_floor_ceiling = opposite_view_factor(x, y), f_floor_walls = 1.0 - f_floor_ceiling;
  const double f_walls_floor = f_floor_walls / walls_per_floor, f_walls_walls = 1.0 - 2.0 * f_walls_floor;
  // Exitances, by successive reflection: at most 0.7 is left each time.
  double ceiling = rho.ceiling * ceiling_lm, floor = rho.floor * floor_lm,
         walls = rho.walls * walls_lm / walls_per_floor;
  const double first[3] = {ceiling, floor, walls};
  constexpr int kReflections = 120;
  for (int k = 0; k < kReflections; ++k) {
    const double on_ceiling = f_floor_ceiling * floor + f_floor_walls * walls;
    const double on_floor = f_floor_ceiling * ceiling + f_floor_walls * walls;
    const double on_walls = f_walls_floor * (ceiling + floor) + f_walls_walls * walls;
    ceiling = first[0] + rho.ceiling * on_ceiling;
    floor = first[1] + rho.floor * on_floor;
    walls = first[2] + rho.walls * on_walls;
  }
  return f_walls_floor * (ceiling + floor) + f_walls_walls * walls;
}

std::vector<GlareSource> sources_seen(const IntensityTable& intensity, const LuminousOpening& opening,
                                      const Hung& hung, const UgrRoom& room, double spacing_h) {
  std::vector<GlareSource> sources;
  const int nx = static_cast<int>(std::lround(room.x_h / spacing_h)),
            ny = static_cast<int>(std::lround(room.y_h / spacing_h));
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Vec3 at = kHeight_m * Vec3((i + 0.5 - 0.5 * nx) * spacing_h, (j + 0.5) * spacing_h, 1.0);
      const double distance_m = glm::length(at);
      const Vec3 to_eye = hung.local(-at / distance_m);
      sources.push_back(
          glare_source(at, intensity.at(to_eye), projected_luminous_area_m2(opening, to_eye), distance_m));
    }
  }
  return sources;
}

}  // namespace

std::vector<UgrEntry> ugr_table(const IntensityTable& intensity, const LuminousOpening& opening,
                                double spacing_h) {
  const bool long_along_c0 = opening.length_m > opening.width_m;
  const auto sight = LineOfSight::along({0, 1, 0});
  const double per_m2 = 1.0 / std::pow(spacing_h * kHeight_m, 2);
  std::vector<UgrEntry> table;
  for (const auto& room : kUgrRooms) {
    std::array<UgrEntry, kUgrReflectances.size()> entries;
    for (const bool endwise : {false, true}) {
      const Hung hung = Hung::with(endwise == long_along_c0);
      const Fluxes flux = fluxes(intensity, hung, room);
      const auto sources = sources_seen(intensity, opening, hung, room, spacing_h);
      for (std::size_t k = 0; k < entries.size(); ++k) {
        entries[k].room = room;
        entries[k].reflectances = kUgrReflectances[k];
        const double wall_lx =
            indirect_wall_lx(room, kUgrReflectances[k], per_m2 * flux.up_lm, per_m2 * flux.floor_lm,
                             per_m2 * (flux.down_lm - flux.floor_lm));
        const double ugr = unified_glare_rating(sources, wall_lx / kPi, sight).ugr;
        (endwise ? entries[k].endwise : entries[k].crosswise) = ugr;
      }
    }
    table.insert(table.end(), entries.begin(), entries.end());
  }
  return table;
}

}  // namespace dim
