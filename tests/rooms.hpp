#pragma once

#include <string>
#include <vector>

#include "scene/zone.hpp"

/// Zones built in code for tests that are about light, not about files.
namespace dim::test {

inline int add_grey(Zone& zone, double reflectance) {
  Finish finish;
  finish.name = "grey" + std::to_string(zone.finishes.size());
  finish.diffuse = SpectralCurve(reflectance);
  zone.finishes.push_back(finish);
  return static_cast<int>(zone.finishes.size()) - 1;
}

inline void add_surface(Zone& zone, const std::string& name, const Ring3& corners, int finish,
                        double cell_m) {
  Surface surface;
  surface.name = name;
  surface.polygon = Polygon(corners);
  surface.finish = finish;
  surface.cell_m = cell_m;
  zone.surfaces.push_back(surface);
}

/// Box seen from inside, or with `outward` a closed obstruction. Faces: floor, ceiling, y0, y1, x0, x1.
inline void add_box(Zone& zone, const std::string& name, const Vec3& lo, const Vec3& hi, int finish,
                    double cell_m, bool outward = false) {
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  const std::vector<std::pair<std::string, Ring3>> faces = {
      {"floor", {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
      {"ceiling", {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}},
      {"y0", {at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
      {"y1", {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
      {"x0", {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
      {"x1", {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}}};
  for (const auto& [face, corners] : faces) {
    Ring3 ring = corners;
    if (outward) ring = Ring3(corners.rbegin(), corners.rend());
    add_surface(zone, name + face, ring, finish, cell_m);
    zone.surfaces.back().bounding = !outward;
  }
}

/// Empty box of one grey, centred on the origin.
inline Zone box_zone(const Vec3& size_m, double reflectance, double cell_m) {
  Zone zone;
  zone.name = "box";
  zone.diameter_m = glm::length(size_m);
  add_box(zone, "", -size_m / 2.0, size_m / 2.0, add_grey(zone, reflectance), cell_m);
  return zone;
}

}  // namespace dim::test
