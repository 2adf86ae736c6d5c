#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "network/network.hpp"
#include "scene/lights_reader.hpp"
#include "transport/simulate.hpp"
#include "unit/scene_support.hpp"

/// Rooms under a sky, and what light comes to their points by integration over windows as areas, with the skies of
/// CIE S 011 written down once more: shares nothing with the program but the numbers of the standard.
namespace dim::test {

/// Relative luminance of CIE general skies 1 to 15 (CIE S 011/E:2003, table 1) and of the traditional overcast sky (16).
/// @param sun  unit vector
inline double relative_luminance(int type, const Vec3& direction, const Vec3& sun) {
  if (!(direction.z > 0.0)) return 0.0;
  if (type == 16) return (1.0 + 2.0 * direction.z) / 3.0;
  struct Form {
    double a, b, c, d, e;
  };
  static constexpr Form kForms[15] = {
      {4.0, -0.70, 0.0, -1.0, 0.0},   {4.0, -0.70, 2.0, -1.5, 0.15},   {1.1, -0.80, 0.0, -1.0, 0.0},
      {1.1, -0.80, 2.0, -1.5, 0.15},  {0.0, -1.0, 0.0, -1.0, 0.0},     {0.0, -1.0, 2.0, -1.5, 0.15},
      {0.0, -1.0, 5.0, -2.5, 0.30},   {0.0, -1.0, 10.0, -3.0, 0.45},   {-1.0, -0.55, 2.0, -1.5, 0.15},
      {-1.0, -0.55, 5.0, -2.5, 0.30}, {-1.0, -0.55, 10.0, -3.0, 0.45}, {-1.0, -0.32, 10.0, -3.0, 0.45},
      {-1.0, -0.32, 16.0, -3.0, 0.30}, {-1.0, -0.15, 16.0, -3.0, 0.30}, {-1.0, -0.15, 24.0, -2.8, 0.15}};
  const Form& k = kForms[type - 1];
  const double chi = std::acos(std::clamp(glm::dot(direction, sun), -1.0, 1.0));
  const double gradation = 1.0 + k.a * std::exp(k.b / direction.z);
  return gradation * (1.0 + k.c * (std::exp(k.d * chi) - std::exp(k.d * kPi / 2.0)) + k.e * std::pow(std::cos(chi), 2));
}

/// Horizontal illuminance of a sky of relative luminances: midpoints, 1e-5.
inline double horizontal_of(int type, const Vec3& sun) {
  constexpr int kRows = 500, kTurns = 500;
  double sum = 0.0;
  for (int i = 0; i < kRows; ++i) {
    const double z = std::sqrt((i + 0.5) / kRows), level = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2.0 * kPi * (j + 0.5) / kTurns;
      sum += relative_luminance(type, {level * std::cos(turn), level * std::sin(turn), z}, sun);
    }
  }
  return kPi * sum / (kRows * static_cast<double>(kTurns));
}

/// A flat rectangle that light comes through.
struct Gap {
  Vec3 corner, u, v;  ///< sides; light travels along cross(u, v)
};

/// Illuminance at a point of light through a rectangle: the integral of radiance(direction, incidence) over its area.
inline double through(const Gap& gap, const Vec3& at, const Vec3& normal,
                      const std::function<double(const Vec3& on_gap, const Vec3& direction, double incidence)>& radiance,
                      int n_u = 180, int n_v = 180) {
  const Vec3 area = glm::cross(gap.u, gap.v), inwards = glm::normalize(area);
  double sum = 0.0;
  for (int i = 0; i < n_u; ++i) {
    for (int j = 0; j < n_v; ++j) {
      const Vec3 q = gap.corner + (i + 0.5) / n_u * gap.u + (j + 0.5) / n_v * gap.v;
      const double r = glm::length(q - at);
      const Vec3 direction = (q - at) / r;
      const double cosine = glm::dot(normal, direction), incidence = -glm::dot(inwards, direction);
      if (cosine > 0.0 && incidence > 0.0) sum += cosine * incidence / (r * r) * radiance(q, direction, incidence);
    }
  }
  return sum * glm::length(area) / (n_u * static_cast<double>(n_v));
}

struct DaylitRoom {
  Zone zone;
  Solution solution;

  /// Direct illuminance of a point by sources of a name, in any group that stands as the zone file has it, lx.
  double direct_lx(std::size_t point, const std::string& name) const {
    double lx = 0.0;
    for (std::size_t s = 0; s < solution.sources.size(); ++s) {
      if (solution.sources[s].name == name && solution.sources[s].daylight->as_it_stands)
        lx += static_cast<double>(solution.point_direct[s * solution.n_direct_classes * solution.n_points + point]);
    }
    return lx;
  }
  /// Total illuminance of a point in the only class of a grey room, lx.
  double total_lx(std::size_t point, std::size_t source) const {
    return static_cast<double>(solution.point_total[solution.point_row(source, 0) + point]);
  }
};

inline DaylitRoom daylit_on(Zone zone, const std::string& sky, const NetworkOptions& options) {
  DaylitRoom room;
  room.zone = std::move(zone);
  Warnings warnings;
  const Lights lights = read_lights("dim = \"lights/1\"\n[sky]\n" + sky, "lights.toml", {}, room.zone, {}, warnings);
  const Cells cells(room.zone);
  const Network network = build_network(room.zone, cells, options, Job{});
  room.solution = simulate(room.zone, cells, network, lights, {}, Job{}, warnings);
  return room;
}

inline DaylitRoom daylit(Zone zone, const std::string& sky, const PatchGrid& patches = {6, 12}) {
  return daylit_on(std::move(zone), sky, NetworkOptions{patches, patches});
}

inline DaylitRoom daylit(const std::string& zone_text, const std::string& sky, const PatchGrid& patches = {6, 12}) {
  return daylit(read(zone_text), sky, patches);
}

/// Walls of one grey, floor first; what a surface of the zone file has beside is added as text.
inline std::string box_text(const Vec3& size, double grey, const std::string& more, double cell = 0.5) {
  return "dim = \"zone/1\"\ncell = " + std::to_string(cell) + "\n[finishes]\ngrey = " + std::to_string(grey) +
         "\npane = { kind = \"glazing\", transmittance = 0.7, ior = 1.52, reflectance = 0 }\n" +
         "hole = { kind = \"glazing\", transmittance = 1.0, angular_law = \"constant\" }\n" +
         "[[room]]\nsize = [" + std::to_string(size.x) + ", " + std::to_string(size.y) +
         "]\nheight = " + std::to_string(size.z) + "\nfloor = \"grey\"\nwalls = \"grey\"\nceiling = \"grey\"\n" + more;
}

}  // namespace dim::test
