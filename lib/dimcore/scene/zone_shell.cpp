#include "scene/zone_shell.hpp"

namespace dim {

ShellCheck check_shell(const std::vector<Surface>& surfaces, const ZoneFrame&, double, Problems&, Warnings&) {
  ShellCheck result;
  for (const auto& surface : surfaces) {
    if (!surface.bounding || surface.parent >= 0) continue;
    const auto& polygon = surface.polygon;
    result.volume_m3 -= glm::dot(polygon.centroid(), polygon.normal()) * polygon.area_m2() / 3.0;
  }
  return result;
}

}  // namespace dim
