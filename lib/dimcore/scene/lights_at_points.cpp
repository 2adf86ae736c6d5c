#include "scene/lights_at_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.hpp"

namespace dim {
namespace {

constexpr double kRelativeTouch = 1e-6;  // of the zone

std::string name_of(const Zone& zone, std::size_t point) {
  const auto set = std::find_if(zone.point_sets.begin(), zone.point_sets.end(), [&](const PointSet& s) {
    return s.first <= point && point < s.first + s.count;
  });
  return fmt::format("point {} of '{}'", point - set->first + 1, set->name);
}

}  // namespace

Warnings warn_of_lights_at_points(const Zone& zone, const Lights& lights) {
  const double touch_m = kRelativeTouch * zone.diameter_m;
  std::vector<Box3> boxes;
  for (const auto& point : zone.points) boxes.emplace_back().add(point.position);
  const BoxTree tree(std::move(boxes));
  const Luminaire* first = nullptr;
  std::size_t first_point = 0, n = 0;
  for (const auto& luminaire : lights.luminaires) {
    const Vec2 half_m = 0.5 * Vec2(luminaire.opening.length_m, luminaire.opening.width_m);
    Box3 around;
    around.add(luminaire.at);
    tree.for_meeting(around.widened(glm::length(half_m) + touch_m), [&](std::size_t p) {
      const Vec3 d = luminaire.to_local(zone.points[p].position - luminaire.at);
      if (std::abs(d.x) > half_m.x + touch_m || std::abs(d.y) > half_m.y + touch_m || std::abs(d.z) > touch_m) return;
      ++n;
      if (first && (first != &luminaire || p > first_point)) return;
      first = &luminaire;
      first_point = p;
    });
  }
  if (!first) return {};
  std::string what = fmt::format("luminaire '{}' stands on {}", first->name, name_of(zone, first_point));
  if (n > 1) what += fmt::format(", and {} more such {}", n - 1, n == 2 ? "pair" : "pairs");
  return {{first->place, what + ": its direct light there is left out", "move the luminaire or the point apart"}};
}

}  // namespace dim
