#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "network/network.hpp"
#include "rooms.hpp"
#include "scene/lights.hpp"
#include "light/direct_light.hpp"
#include "light/first_flight.hpp"
#include "transport/simulate.hpp"

/// Light sources in code, and the closed forms that tests of direct light compare with.
namespace dim::test {

struct LampOptions {
  Vec3 aim{0, 0, -1};
  LuminousOpening opening{};
  double factor = 1.0;
  bool body = false;
  std::string group{};
};

inline LuminousOpening rectangle(double length_m, double width_m) {
  return {OpeningShape::kRectangle, length_m, width_m, 0.0};
}

/// Adds a luminaire with a fitting of its own; a group of its own too where none is given.
inline Luminaire& add_lamp(Lights& lights, const std::string& name, const Vec3& at,
                           const IntensityTable& intensity, const LampOptions& options = {}) {
  lights.fittings.push_back(
      {name, intensity, options.opening, intensity.flux_lm(), SpectralCurve(1.0), false, "", 0.0});
  Luminaire lamp;
  lamp.name = name;
  lamp.group = options.group.empty() ? name : options.group;
  lamp.fitting = static_cast<int>(lights.fittings.size()) - 1;
  lamp.at = at;
  lamp.aim = glm::normalize(options.aim);
  lamp.c0 = perpendicular(lamp.aim);
  if (std::abs(lamp.aim.x) < 1e-12 && std::abs(lamp.aim.y) < 1e-12) lamp.c0 = {1, 0, 0};
  lamp.c90 = glm::cross(lamp.c0, lamp.aim);
  lamp.factor = options.factor;
  lamp.opening = options.opening;
  lamp.body = options.body;
  lights.luminaires.push_back(lamp);
  return lights.luminaires.back();
}

inline Lights point_lamp(const Vec3& at, double intensity_cd) {
  Lights lights;
  add_lamp(lights, "lamp", at, IntensityTable::isotropic(1.0), {.factor = intensity_cd});
  return lights;
}

/// Every luminaire a source of its own.
inline DirectLight direct(const Zone& zone, const Lights& lights) {
  std::vector<std::size_t> source_of(lights.luminaires.size());
  for (std::size_t l = 0; l < source_of.size(); ++l) source_of[l] = l;
  return direct_light(zone, Cells(zone), lights, source_of, source_of.size(), Job{});
}

/// The first flights of all luminaires.
inline std::vector<FirstFlight> flights_of(const Zone& zone, const Lights& lights, int n_rays) {
  return first_flights(zone, lights, Obstructions(zone, lights).caster(), n_rays, Job{});
}

inline Network network_of(const Zone& zone, const PatchGrid& patches = {}) {
  NetworkOptions options;
  options.patches = patches;
  options.point_patches = patches;
  return build_network(zone, Cells(zone), options, Job{});
}

inline Solution solve(const Zone& zone, const Lights& lights, const Network& network,
                      const SimulationOptions& options = {}) {
  Warnings warnings;
  return simulate(zone, Cells(zone), network, lights, options, Job{}, warnings);
}

/// One rectangle looking up, [lo, hi] at height z, nu x nv cells.
inline void add_floor(Zone& zone, const Vec2& lo, const Vec2& hi, double z, int nu, int nv) {
  if (zone.finishes.empty()) add_grey(zone, 0.0);
  add_surface(zone, "floor" + std::to_string(zone.surfaces.size()),
              {{lo.x, lo.y, z}, {hi.x, lo.y, z}, {hi.x, hi.y, z}, {lo.x, hi.y, z}}, 0, 1.0);
  zone.surfaces.back().grid = {nu, nv};
}

/// Solid angle of the rectangle [lo, hi] in a plane, seen from a height above the plane's origin.
inline double solid_angle_sr(const Vec2& lo, const Vec2& hi, double height_m) {
  const auto corner = [&](double x, double y) {
    return std::atan(x * y / (height_m * std::sqrt(x * x + y * y + height_m * height_m)));
  };
  return corner(hi.x, hi.y) - corner(lo.x, hi.y) - corner(hi.x, lo.y) + corner(lo.x, lo.y);
}

/// Illuminance at p (normal n) from a polygon of uniform luminance wholly above p's horizon: Lambert's
/// formula, E = L/2 sum over edges of the angle they subtend times n . unit normal of the wedge. Unsigned.
inline double lambert_lx(const Vec3& p, const Vec3& n, const Ring3& polygon, double luminance_cd_m2) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = glm::normalize(polygon[i] - p), b = glm::normalize(polygon[(i + 1) % polygon.size()] - p);
    const Vec3 wedge = glm::cross(a, b);
    const double sine = glm::length(wedge);
    if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(n, wedge / sine);
  }
  return luminance_cd_m2 / 2.0 * std::abs(sum);
}

/// Area-weighted sum of a column [n_cells, n_columns].
inline double total(const Cells& cells, const std::vector<double>& values, std::size_t n_columns = 1,
                    std::size_t column = 0) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) sum += cells.area_m2(i) * values[i * n_columns + column];
  return sum;
}

inline double area_m2(const Cells& cells) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) sum += cells.area_m2(i);
  return sum;
}

/// Illuminance of the cells (or points) from one source, lx.
/// @param transfer  a part of the solution, [n_sources, n_classes or one, n]
inline std::vector<double> illuminance_lx(const Solution& solution, const std::vector<float>& transfer,
                                          std::size_t source, std::size_t n) {
  std::vector<double> lx(n, 0.0);
  const auto xyz = solution.sources[source].xyz_by_class(solution.classes);
  const std::size_t n_classes = n ? transfer.size() / (n * solution.sources.size()) : 0;
  for (std::size_t q = 0; q < xyz.size(); ++q) {
    const std::size_t row = (source * n_classes + std::min(q + 1, n_classes) - 1) * n;
    for (std::size_t i = 0; i < n; ++i) lx[i] += xyz[q].y * static_cast<double>(transfer[row + i]);
  }
  return lx;
}

inline std::vector<double> cell_lx(const Solution& solution, std::size_t source = 0) {
  return illuminance_lx(solution, solution.cell_total, source, solution.n_cells);
}

inline std::vector<double> cell_direct_lx(const Solution& solution, std::size_t source = 0) {
  return illuminance_lx(solution, solution.cell_direct, source, solution.n_cells);
}

inline std::vector<double> point_lx(const Solution& solution, std::size_t source = 0) {
  return illuminance_lx(solution, solution.point_total, source, solution.n_points);
}

/// Room 6 x 4 x 2.8 centred on the origin with a desk and a cabinet, all of one grey.
inline Zone furnished_room(double reflectance, double cell_m) {
  Zone zone = box_zone({6, 4, 2.8}, reflectance, cell_m);
  add_box(zone, "desk.", {-1, -1, -0.7}, {0.6, -0.2, -0.65}, 0, cell_m, true);
  add_box(zone, "cabinet.", {2.2, 0.5, -1.2}, {2.8, 1.9, 0.4}, 0, cell_m, true);
  return zone;
}

}  // namespace dim::test
