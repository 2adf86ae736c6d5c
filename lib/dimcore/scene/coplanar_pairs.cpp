#include "scene/coplanar_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dim {
namespace {

struct Box {
  Vec3 low{std::numeric_limits<double>::max()};
  Vec3 high{std::numeric_limits<double>::lowest()};

  void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  bool touches(const Box& o, double d) const {
    return low.x <= o.high.x + d && o.low.x <= high.x + d && low.y <= o.high.y + d && o.low.y <= high.y + d &&
           low.z <= o.high.z + d && o.low.z <= high.z + d;
  }
};

Box box_of(const Polygon& polygon) {
  Box box;
  for (const auto& ring : polygon.rings())
    for (const auto& p : ring) box.add(polygon.frame().to_world(p));
  return box;
}

int longest_axis(const std::vector<Box>& boxes) {
  Box all;
  for (const auto& box : boxes) {
    if (box.low.x <= box.high.x) all.add(box.low), all.add(box.high);
  }
  const Vec3 size = all.high - all.low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

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
  Region2 region;
  for (const auto& ring : other.rings()) {
    Ring2 flat;
    for (const auto& p : ring) flat.push_back(base.frame().to_local(other.frame().to_world(p)));
    region.push_back(std::move(flat));
  }
  // Seen from behind, outlines run the other way.
  if (glm::dot(other.normal(), base.normal()) < 0.0)
    for (auto& ring : region) std::reverse(ring.begin(), ring.end());
  return snapped(region, base.rings(), touch_m);
}

std::vector<CoplanarPair> coplanar_pairs(const std::vector<Surface>& surfaces, double touch_m) {
  constexpr double kParallel = 0.999;  // cheap first test; the plane test decides
  constexpr std::size_t kMaxPairs = 10'000, kMaxPairsPerSurface = 50;  // far beyond any real room
  std::vector<Box> boxes;
  for (const auto& surface : surfaces) boxes.push_back(box_of(surface.polygon));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (!surfaces[i].outside && surfaces[i].polygon.area_m2() > 0.0) order.push_back(i);
  const int axis = longest_axis(boxes);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return boxes[a].low[axis] != boxes[b].low[axis] ? boxes[a].low[axis] < boxes[b].low[axis] : a < b;
  });
  std::vector<CoplanarPair> pairs;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t i = order[k];
    for (std::size_t m = k + 1;
         m < order.size() && boxes[order[m]].low[axis] <= boxes[i].high[axis] + touch_m; ++m) {
      const std::size_t j = order[m];
      const Polygon &a = surfaces[i].polygon, &b = surfaces[j].polygon;
      const double facing = glm::dot(a.normal(), b.normal());
      if (std::abs(facing) < kParallel || !boxes[i].touches(boxes[j], touch_m)) continue;
      if (surfaces[i].twin == static_cast<int>(j)) continue;
      const bool i_large = a.area_m2() > b.area_m2() || (a.area_m2() == b.area_m2() && i < j);
      const std::size_t large = i_large ? i : j, small = i_large ? j : i;
      const Polygon& base = surfaces[large].polygon;
      if (lies_in_plane(surfaces[small].polygon, base.frame(), touch_m) &&
          rectangles_overlap(base, surfaces[small].polygon, touch_m))
        pairs.push_back({large, small, facing > 0.0});
      if (pairs.size() > kMaxPairs + kMaxPairsPerSurface * surfaces.size())
        throw InputError(
            {surfaces[small].place,
             fmt::format("surface '{}' is one of very many that lie on top of each other in one plane",
                         surfaces[small].name),
             "give each copy a displacement of its own"});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const CoplanarPair& a, const CoplanarPair& b) {
    return std::pair(std::min(a.large, a.small), std::max(a.large, a.small)) <
           std::pair(std::min(b.large, b.small), std::max(b.large, b.small));
  });
  return pairs;
}

}  // namespace dim
