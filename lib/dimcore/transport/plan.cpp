#include "transport/plan.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

bool any_corner_behind(const Zone& zone, const Frame& frame) {
  const double tolerance_m = 1e-9 * zone.diameter_m;
  return std::any_of(zone.surfaces.begin(), zone.surfaces.end(), [&](const Surface& surface) {
    const auto& ring = surface.polygon.rings().front();
    return std::any_of(ring.begin(), ring.end(), [&](const Vec2& p) {
      return frame.height(surface.polygon.frame().to_world(p)) < -tolerance_m;
    });
  });
}

}  // namespace

bool is_convex_and_empty(const Zone& zone, const Lights& lights) {
  if (!zone.closed) return false;
  const double tolerance_m = 1e-9 * zone.diameter_m;
  for (const auto& surface : zone.surfaces) {
    const Frame& frame = surface.polygon.frame();
    const bool shell = surface.bounding || surface.parent >= 0;
    if (!shell || surface.outside || any_corner_behind(zone, frame)) return false;
    const auto outside = [&](const Luminaire& luminaire) {
      const double reach_m = std::abs(glm::dot(luminaire.c0, frame.n)) * luminaire.opening.length_m / 2.0 +
                             std::abs(glm::dot(luminaire.c90, frame.n)) * luminaire.opening.width_m / 2.0 +
                             std::abs(glm::dot(luminaire.aim, frame.n)) * luminaire.opening.height_m / 2.0;
      return luminaire.body || frame.height(luminaire.at) < reach_m - tolerance_m;
    };
    const auto beyond = [&](const MeasuringPoint& point) {
      return frame.height(point.position) < -tolerance_m;
    };
    if (std::any_of(lights.luminaires.begin(), lights.luminaires.end(), outside) ||
        std::any_of(zone.points.begin(), zone.points.end(), beyond))
      return false;
  }
  return true;
}

}  // namespace dim
