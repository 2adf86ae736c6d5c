#include "scene/surface_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "scene/coplanar_pairs.hpp"

namespace dim {
namespace {

constexpr double kRelativeOverlap = 1e-9;
constexpr std::size_t kMostNamed = 3;

int depth_of(const std::vector<Surface>& surfaces, std::size_t i) {
  int depth = 0;
  for (int at = surfaces[i].parent; at >= 0; at = surfaces[static_cast<std::size_t>(at)].parent) ++depth;
  return depth;
}

// Areas that differ by rounding are alike: copies of one thing in several places.
bool lies_on_top(const std::vector<Surface>& surfaces, std::size_t a, std::size_t b) {
  constexpr double kAlike = 1e-9;
  const double area_a = surfaces[a].polygon.area_m2(), area_b = surfaces[b].polygon.area_m2();
  if (std::abs(area_a - area_b) > kAlike * std::max(area_a, area_b)) return area_a < area_b;
  return std::pair(depth_of(surfaces, a), a) > std::pair(depth_of(surfaces, b), b);
}

/// One line a kind: the first in full, the next by name, the rest by number.
class OverlapLine {
 public:
  void add(const Surface& on_top, const Surface& below, double common_m2) {
    if (n_++ == 0) {
      place_ = on_top.place;
      first_ = fmt::format("surface '{}' and surface '{}' (line {}) overlap in one plane by {:.6g} m2: '{}' lies on top",
                           on_top.name, below.name, below.place.line, common_m2, on_top.name);
      below_ = below.name;
    } else if (n_ <= kMostNamed) {
      others_ += fmt::format("{}'{}' on '{}' (line {})", others_.empty() ? "" : ", ", on_top.name, below.name,
                             on_top.place.line);
    }
  }

  bool empty() const { return n_ == 0; }
  const std::string& first_below() const { return below_; }

  Problem warning(const std::string& cure) const {
    std::string what = first_;
    if (n_ > 1) what += "; so do " + others_;
    if (n_ > kMostNamed) what += fmt::format(" and {} more", n_ - kMostNamed);
    return {place_, what, cure};
  }

 private:
  std::size_t n_ = 0;
  Place place_;
  std::string first_, others_, below_;
};

}  // namespace

std::vector<SurfaceOverlap> find_overlaps(const std::vector<Surface>& whole, const std::vector<Surface>& cut,
                                          const std::vector<SurfaceLink>& links, double touch_m,
                                          Warnings& warnings) {
  std::vector<SurfaceOverlap> overlaps;
  OverlapLine surfaces, bodies;
  for (const auto& pair : coplanar_pairs(whole, touch_m)) {
    if (!pair.same_facing || is_ancestor(whole, pair.large, pair.small) ||
        is_ancestor(whole, pair.small, pair.large))
      continue;
    const bool small_on_top = lies_on_top(whole, pair.small, pair.large);
    const SurfaceOverlap overlap{small_on_top ? pair.large : pair.small,
                                 small_on_top ? pair.small : pair.large};
    const Surface &below = cut[overlap.below], &on_top = whole[overlap.on_top];
    if (!(below.polygon.area_m2() > 0.0)) continue;
    const double common_m2 = common_area_m2(below.polygon, on_top.polygon, touch_m);
    if (common_m2 <= kRelativeOverlap * on_top.polygon.area_m2()) continue;
    overlaps.push_back(overlap);
    const bool of_body = links[overlap.below].of_box || links[overlap.on_top].of_box || below.twin >= 0 ||
                         on_top.twin >= 0;
    (of_body ? bodies : surfaces).add(on_top, below, common_m2);
  }
  if (!surfaces.empty())
    warnings.push_back(surfaces.warning(
        fmt::format("write on = \"{}\" if it is a feature of that surface, or move it", surfaces.first_below())));
  if (!bodies.empty()) warnings.push_back(bodies.warning("move or shorten one of them if that is not meant"));
  return overlaps;
}

void cut_overlaps(std::vector<Surface>& surfaces, const std::vector<Surface>& whole,
                  const std::vector<SurfaceOverlap>& overlaps, double touch_m) {
  std::map<std::size_t, std::vector<const Polygon*>> removed;
  for (const auto& overlap : overlaps) {
    removed[overlap.below].push_back(&whole[overlap.on_top].polygon);
    const int below_back = whole[overlap.below].twin, top_back = whole[overlap.on_top].twin;
    if (top_back >= 0 && below_back < 0)
      removed[static_cast<std::size_t>(top_back)].push_back(&whole[overlap.below].polygon);
    if (below_back >= 0 && top_back < 0)
      removed[static_cast<std::size_t>(below_back)].push_back(&whole[overlap.on_top].polygon);
  }
  for (const auto& [i, others] : removed)
    if (surfaces[i].polygon.area_m2() > 0.0) cut_out(surfaces[i].polygon, others, touch_m);
}

std::vector<SurfaceOverlap> of_bounding(const std::vector<SurfaceOverlap>& overlaps,
                                        const std::vector<Surface>& surfaces) {
  auto chosen = overlaps;
  std::erase_if(chosen, [&](const SurfaceOverlap& overlap) {
    return !surfaces[overlap.below].bounding || !surfaces[overlap.on_top].bounding;
  });
  return chosen;
}

}  // namespace dim
