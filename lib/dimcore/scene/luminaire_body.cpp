#include "scene/luminaire_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace dim {
namespace {

// Where the opening looks.
Vec3 facing(const Luminaire& luminaire) {
  return luminaire.opening.shape == OpeningShape::kVerticalEllipse ? luminaire.c0 : luminaire.aim;
}

double depth_m(const LuminousOpening& opening) {
  switch (opening.shape) {
    case OpeningShape::kBox:
    case OpeningShape::kVerticalCylinder:
      return opening.height_m;
    case OpeningShape::kEllipsoid:
    case OpeningShape::kHorizontalCylinder:
      return opening.height_m / 2.0;
    default:
      return 0.0;
  }
}

Ring3 outline_behind(const Luminaire& luminaire, double behind_m) {
  const Vec3 centre = luminaire.at - behind_m * facing(luminaire);
  Ring3 ring = outline(luminaire.opening);
  for (auto& p : ring) p = centre + luminaire.to_world(p);
  return ring;
}

Surface face(const Luminaire& luminaire, const std::string& which, Polygon polygon) {
  Surface surface;
  surface.name = fmt::format("luminaire '{}' {}", luminaire.name, which);
  surface.polygon = std::move(polygon);
  surface.bounding = false;
  surface.place = luminaire.place;
  return surface;
}

// By place, each once: luminaires of one place and shape, as the channels of a tunable one, have one body.
std::vector<const Luminaire*> distinct_bodies(const Lights& lights) {
  std::vector<const Luminaire*> bodies;
  for (const auto& luminaire : lights.luminaires) {
    if (has_body(luminaire)) bodies.push_back(&luminaire);
  }
  const auto key = [](const Luminaire* l) {
    const LuminousOpening& o = l->opening;
    return std::tuple(l->at.x, l->at.y, l->at.z, l->aim.x, l->aim.y, l->aim.z, l->c0.x, l->c0.y, l->c0.z, o.shape,
                      o.length_m, o.width_m, o.height_m, l->body_reflectance);
  };
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](const Luminaire* a, const Luminaire* b) { return key(a) < key(b); });
  const auto same = [&](const Luminaire* a, const Luminaire* b) { return key(a) == key(b); };
  bodies.erase(std::unique(bodies.begin(), bodies.end(), same), bodies.end());
  return bodies;
}

Finish body_finish(double reflectance) {
  Finish finish;
  finish.name = fmt::format("luminaire body {:.4g}", reflectance);
  finish.diffuse = SpectralCurve(reflectance);
  finish.source = "lights";
  return finish;
}

}  // namespace

bool has_body(const Luminaire& luminaire) { return luminaire.body && area_m2(luminaire.opening) > 0.0; }

std::vector<Surface> body_surfaces(const Luminaire& luminaire) {
  if (!has_body(luminaire)) return {};
  const Ring3 front = outline_behind(luminaire, kBehindOpening_m);
  const Polygon facing_out(Ring3(front.rbegin(), front.rend()));
  const double depth = depth_m(luminaire.opening);
  std::vector<Surface> surfaces = {face(luminaire, "front", facing_out)};
  if (!(depth > 0.0)) {
    surfaces.push_back(face(luminaire, "back", facing_out.reversed()));
    surfaces[0].twin = 1;
    surfaces[1].twin = 0;
    return surfaces;
  }
  const Ring3 back = outline_behind(luminaire, kBehindOpening_m + depth);
  surfaces.push_back(face(luminaire, "back", Polygon(back)));
  for (std::size_t i = 0; i < front.size(); ++i) {
    const std::size_t next = (i + 1) % front.size();
    surfaces.push_back(face(luminaire, fmt::format("side {}", i + 1),
                            Polygon(Ring3{front[i], front[next], back[next], back[i]})));
  }
  return surfaces;
}

std::size_t count_bodies(const Lights& lights) { return distinct_bodies(lights).size(); }

Zone with_bodies(const Zone& zone, const Lights& lights, double cell_m) {
  Zone result = zone;
  std::map<double, int> finishes;
  for (const Luminaire* luminaire : distinct_bodies(lights)) {
    const auto [finish, added] =
        finishes.emplace(luminaire->body_reflectance, static_cast<int>(result.finishes.size()));
    if (added) result.finishes.push_back(body_finish(luminaire->body_reflectance));
    const int first = static_cast<int>(result.surfaces.size());
    for (auto& surface : body_surfaces(*luminaire)) {
      surface.finish = finish->second;
      surface.cell_m = cell_m;
      if (surface.twin >= 0) surface.twin += first;
      result.surfaces.push_back(std::move(surface));
    }
  }
  return result;
}

Vec3 clear_of_surfaces(const Luminaire& luminaire, const Zone& zone) {
  constexpr double kClear_m = 2.0 * kBehindOpening_m;
  constexpr double kParallel = 1.0 - 1e-6;
  Vec3 at = luminaire.at;
  if (!has_body(luminaire)) return at;
  const double tolerance_m = 1e-6 * zone.diameter_m;
  for (const auto& surface : zone.surfaces) {
    const Frame& plane = surface.polygon.frame();
    const double height_m = plane.height(at);
    if (surface.outside || height_m < -tolerance_m || height_m >= kClear_m ||
        glm::dot(facing(luminaire), plane.n) < kParallel ||
        !surface.polygon.contains(plane.to_local(at), tolerance_m))
      continue;
    at += (kClear_m - height_m) * plane.n;
  }
  return at;
}

}  // namespace dim
