#include "scene/corner_behind.hpp"

#include <algorithm>

namespace dim {

bool any_corner_behind(const Zone& zone, const Frame& frame, double tolerance_m) {
  return std::any_of(zone.surfaces.begin(), zone.surfaces.end(), [&](const Surface& surface) {
    const auto& ring = surface.polygon.rings().front();
    return std::any_of(ring.begin(), ring.end(), [&](const Vec2& p) {
      return frame.height(surface.polygon.frame().to_world(p)) < -tolerance_m;
    });
  });
}

}  // namespace dim
