// Tabular UGR against a second implementation by plain summation: luminaires one by one, floor and walls
// point by point, exchange between the surfaces by numerical integration.
#include "glare/ugr_table.hpp"

#include <array>
#include <sstream>

#include "catch.hpp"
#include "photometry/photometry_file.hpp"
#include "shared_data.hpp"

using namespace dim;

namespace {

struct Lamp {
  IntensityTable intensity;
  double a = 0.6, b = 0.6;  // of the opening along C0 and C90, flat
};

struct Room {
  double x, y;  // H = 1
  bool c0_along_y;
};

// Candela towards a direction of the room: x across, y along the line of sight, z up, aim down.
double candela(const Lamp& lamp, const Room& room, double dx, double dy, double dz) {
  // c90 = c0 x aim: with c0 = +y it is -x, with c0 = +x it is +y.
  return room.c0_along_y ? lamp.intensity.at({dy, -dx, -dz}) : lamp.intensity.at({dx, dy, -dz});
}

double guth(double across, double along, double up) {
  const double sigma = std::acos(along / std::sqrt(across * across + along * along + up * up)) * 180.0 / kPi;
  const double tau = std::atan2(std::abs(across), up) * 180.0 / kPi;
  const double linear = 35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0);
  const double square = 21.0 + 0.26667 * tau - 0.002963 * tau * tau;
  return std::exp(1e-3 * linear * sigma + 1e-5 * square * sigma * sigma);
}

// Share of what a rectangle sends evenly in all directions that falls on the equal one opposite.
double opposite(double x, double y) {
  const int n = 24;
  double sum = 0.0;
  for (int i = 0; i < n * n; ++i)
    for (int j = 0; j < n * n; ++j) {
      const double dx = x * (i % n - j % n) / n, dy = y * (i / n - j / n) / n, r2 = dx * dx + dy * dy + 1.0;
      sum += x * y / (n * n) / (kPi * r2 * r2) / (n * n);
    }
  return sum;
}

struct Summed {
  double glare = 0.0;                                       // sum of L^2 omega / p^2
  double ceiling_lm = 0.0, floor_lm = 0.0, walls_lm = 0.0;  // of all luminaires
};

Summed summed(const Lamp& lamp, const Room& room, double spacing) {
  Summed s;
  const int nx = static_cast<int>(room.x / spacing + 0.5), ny = static_cast<int>(room.y / spacing + 0.5);
  const double scale = 2.0;  // m
  double total = 0.0, up = 0.0;
  for (int g = 0; g < 720; ++g)
    for (int c = 0; c < 360; ++c) {
      const double gamma = (g + 0.5) * kPi / 720, turn = (c + 0.5) * kPi / 180;
      const double cd = candela(lamp, room, std::sin(gamma) * std::cos(turn),
                                std::sin(gamma) * std::sin(turn), -std::cos(gamma));
      const double lm = cd * std::sin(gamma) * kPi / 720 * kPi / 180;
      total += lm;
      if (gamma > kPi / 2) up += lm;
    }
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const double x = (i + 0.5) * spacing - room.x / 2, y = (j + 0.5) * spacing;
      if (std::abs(x) <= 3.0 * y) {
        const double r = std::sqrt(x * x + y * y + 1.0);
        const double cd = candela(lamp, room, -x / r, -y / r, -1.0 / r);
        const double area = std::max(0.005, lamp.a * lamp.b / r);
        s.glare += cd * cd / area / (r * r * scale * scale) / std::pow(guth(x, y, 1.0), 2);
      }
      // The floor, point by point.
      const double step = 0.1;
      for (double fx = -room.x / 2 + step / 2; fx < room.x / 2; fx += step)
        for (double fy = step / 2; fy < room.y; fy += step) {
          const double dx = fx - x, dy = fy - y, r2 = dx * dx + dy * dy + 1.0, r = std::sqrt(r2);
          s.floor_lm += candela(lamp, room, dx / r, dy / r, -1.0 / r) / (r2 * r) * step * step;
        }
      s.ceiling_lm += up;
      s.walls_lm += total - up;
    }
  s.walls_lm -= s.floor_lm;
  return s;
}

double ugr_by_sums(const Summed& s, const Room& room, double ceiling, double walls, double floor,
                   double opposite_share) {
  const double area = room.x * room.y, wall_area = 2.0 * (room.x + room.y);
  const double to_walls = 1.0 - opposite_share, from_walls = to_walls * area / wall_area;
  // Flux by flux: what arrives anew each time, in lm.
  double c = s.ceiling_lm, f = s.floor_lm, w = s.walls_lm, indirect_on_walls = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double sc = ceiling * c, sf = floor * f, sw = walls * w;
    c = opposite_share * sf + from_walls * sw;
    f = opposite_share * sc + from_walls * sw;
    w = to_walls * (sc + sf) + (1.0 - 2.0 * from_walls) * sw;
    indirect_on_walls += w;
  }
  const double scale2 = 4.0;  // m2
  return 8.0 * std::log10(0.25 * kPi / (indirect_on_walls / (wall_area * scale2)) * s.glare);
}

void compare(const Lamp& lamp, double spacing) {
  const LuminousOpening opening{OpeningShape::kRectangle, lamp.a, lamp.b, 0.0};
  const auto table = ugr_table(lamp.intensity, opening, spacing);
  REQUIRE(table.size() == 95);
  const bool long_along_c0 = lamp.a > lamp.b;
  for (const std::size_t at : {0U, 2U, 9U, 15U}) {  // a room of each width
    const auto& entry = table[5 * at];
    const double share = opposite(entry.room.x_h, entry.room.y_h);
    for (const bool endwise : {false, true}) {
      const Room room{static_cast<double>(entry.room.x_h), static_cast<double>(entry.room.y_h),
                      endwise == long_along_c0};
      const Summed s = summed(lamp, room, spacing);
      for (std::size_t k = 0; k < 5; ++k) {
        const auto& e = table[5 * at + k];
        const auto& rho = e.reflectances;
        CAPTURE(e.room.x_h, e.room.y_h, k, endwise);
        CHECK((endwise ? e.endwise : e.crosswise) ==
              Approx(ugr_by_sums(s, room, rho.ceiling, rho.walls, rho.floor, share)).margin(0.1));
      }
    }
  }
}

IntensityTable shared_intensity(const std::string& name, bool& found) {
  std::ifstream file;
  found = test::open_shared(file, "photometry/" + name);
  if (!found) return IntensityTable::isotropic(1.0);
  std::stringstream bytes;
  bytes << file.rdbuf();
  Warnings warnings;
  return IntensityTable(read_photometry(bytes.str(), name, warnings).distribution);
}

}  // namespace

TEST_CASE("Tabular UGR of a Lambertian panel is that of a sum over its luminaires", "[glare][validation]") {
  compare({IntensityTable::lambertian(1000.0), 0.6, 0.6}, 0.25);
}

TEST_CASE("Tabular UGR of measured luminaires is that of a sum over them", "[glare][validation]") {
  for (const char* name : {"fluorescent_luminaire.ldt", "cu1.ies"}) {
    bool found = false;
    const IntensityTable intensity = shared_intensity(name, found);
    if (!found) return;
    CAPTURE(name);
    compare({intensity, 1.2, 0.3}, 0.25);
  }
}

TEST_CASE("Tabular UGR knows 19 rooms, and brighter walls glare less", "[glare][validation]") {
  const auto table =
      ugr_table(IntensityTable::lambertian(500.0), {OpeningShape::kRectangle, 0.6, 0.6, 0.0}, 1.0);
  REQUIRE(table.size() == 95);
  for (std::size_t room = 0; room < 19; ++room) {
    CHECK(table[5 * room].crosswise < table[5 * room + 1].crosswise);
    CHECK(table[5 * room].crosswise == Approx(table[5 * room].endwise).margin(1e-9));
  }
  // Ten times the light glares by 8 lg 10 more: L^2 over L.
  const auto brighter =
      ugr_table(IntensityTable::lambertian(5000.0), {OpeningShape::kRectangle, 0.6, 0.6, 0.0}, 1.0);
  CHECK(brighter[0].crosswise == Approx(table[0].crosswise + 8.0));
}
