#include "scene/surface_boxes.hpp"

#include <algorithm>

namespace dim {

std::vector<Box3> surface_boxes(const std::vector<Surface>& surfaces) {
  const auto largest = std::max_element(
      surfaces.begin(), surfaces.end(),
      [](const Surface& a, const Surface& b) { return a.polygon.area_m2() < b.polygon.area_m2(); });
  std::vector<Box3> boxes;
  for (const auto& surface : surfaces) {
    Box3& box = boxes.emplace_back();
    for (const auto& ring : surface.polygon.rings())
      for (const auto& p : ring)
        box.add(largest->polygon.frame().direction_to_local(surface.polygon.frame().to_world(p)));
  }
  return boxes;
}

}  // namespace dim
