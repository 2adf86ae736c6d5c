#include "scene/coplanar_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/surface_boxes.hpp"

namespace dim {
namespace {

bool rectangles_overlap(const Polygon& a, const Polygon& b, double touch_m) {
  Vec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& ring : b.rings()) {
    for (const auto& p : ring) {
      const Vec2 q = a.frame().to_local(b.frame().to_world(p));
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
  }
  return low.x < a.size_m().x - touch_m && high.x > touch_m && low.y < a.size_m().y - touch_m &&
         high.y > touch_m;
}

}  // namespace

bool lies_in_plane(const Polygon& polygon, const Frame& plane, double tolerance_m, double* worst_m) {
  double worst = 0.0;
  for (const auto& ring : polygon.rings())
    for (const auto& p : ring) worst = std::max(worst, std::abs(plane.height(polygon.frame().to_world(p))));
  if (worst_m) *worst_m = worst;
  return worst <= tolerance_m;
}

Region2 region_in_frame(const Polygon& other, const Polygon& base, double touch_m) {
  Region2 region = projected(other, base.frame());
  // Seen from behind, outlines run the other way.
  if (glm::dot(other.normal(), base.normal()) < 0.0)
    for (auto& ring : region) std::reverse(ring.begin(), ring.end());
  return snapped(region, base.rings(), touch_m);
}

double common_area_m2(const Polygon& base, const Polygon& other, double touch_m) {
  return area(without_slivers(clip_intersection(base.rings(), region_in_frame(other, base, touch_m)), touch_m));
}

void cut_out(Polygon& polygon, const std::vector<const Polygon*>& others, double touch_m) {
  Region2 removed;
  for (const auto* other : others) {
    const Region2 region = region_in_frame(*other, polygon, touch_m);
    removed.insert(removed.end(), region.begin(), region.end());
  }
  Region2 rest = without_slivers(clip_difference(polygon.rings(), removed), touch_m);
  polygon = rest.empty() ? Polygon{} : Polygon(polygon.frame(), std::move(rest));
}

std::vector<CoplanarPair> coplanar_pairs(const std::vector<Surface>& surfaces, double touch_m) {
  constexpr double kParallel = 0.999;  // cheap first test; the plane test decides
  constexpr std::size_t kMaxPairs = 10'000, kMaxPairsPerSurface = 50;  // far beyond any real room
  std::vector<CoplanarPair> pairs;
  if (surfaces.empty()) return pairs;
  const auto boxes = surface_boxes(surfaces);
  const BoxTree tree(boxes);
  const auto compare = [&](std::size_t i, std::size_t j) {
    const Polygon &a = surfaces[i].polygon, &b = surfaces[j].polygon;
    const double facing = glm::dot(a.normal(), b.normal());
    if (std::abs(facing) < kParallel || surfaces[i].twin == static_cast<int>(j)) return;
    const bool i_large = a.area_m2() >= b.area_m2();
    const std::size_t large = i_large ? i : j, small = i_large ? j : i;
    const Polygon& base = surfaces[large].polygon;
    if (!lies_in_plane(surfaces[small].polygon, base.frame(), touch_m) ||
        !rectangles_overlap(base, surfaces[small].polygon, touch_m))
      return;
    pairs.push_back({large, small, facing > 0.0});
    if (pairs.size() > kMaxPairs + kMaxPairsPerSurface * surfaces.size())
      throw InputError(
          {surfaces[small].place,
           fmt::format("surface '{}' is one of very many that lie on top of each other in one plane",
                       surfaces[small].name),
           "give each copy a displacement of its own"});
  };
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].outside || !(surfaces[i].polygon.area_m2() > 0.0)) continue;
    tree.for_meeting(boxes[i].widened(touch_m), [&](std::size_t j) {
      if (j > i && !surfaces[j].outside) compare(i, j);
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const CoplanarPair& a, const CoplanarPair& b) {
    return std::pair(std::min(a.large, a.small), std::max(a.large, a.small)) <
           std::pair(std::min(b.large, b.small), std::max(b.large, b.small));
  });
  return pairs;
}

}  // namespace dim
