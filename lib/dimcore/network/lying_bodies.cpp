#include "network/lying_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/clip.hpp"
#include "scene/luminaire_body.hpp"

namespace dim {
namespace {

// Bodies of recessed luminaires lie up to twice their distance from the opening before their ceiling (see
// `clear_of_surfaces`). The little light that enters a gap that is low against the cells is given to their free
// part.
constexpr double kTouches_m = 3.0 * kBehindOpening_m;
constexpr double kParallel = 1.0 - 1e-6;
// Less than this of a cell is nothing: it would take all of the cell's rays.
constexpr double kLeastShare = 1e-3;

struct Box2 {
  Vec2 low, high;

  bool meets(const Box2& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
};

struct Print {
  Region2 region;
  Box2 box;
};

// The outline of a body's face on a plane that it lies on; nothing where it does not.
std::optional<Print> print_on(const Frame& plane, const Polygon& face, double gap_m) {
  const double height_m = plane.height(face.centroid());
  if (std::abs(glm::dot(plane.n, face.normal())) < kParallel || height_m < -kTouches_m || height_m > gap_m)
    return std::nullopt;
  const auto corners = face.corners();
  Ring2 ring;
  for (const auto& p : corners.front()) ring.push_back(plane.to_local(p));
  if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  Print print{{ring}, {ring.front(), ring.front()}};
  for (const auto& p : ring) {
    print.box.low = glm::min(print.box.low, p);
    print.box.high = glm::max(print.box.high, p);
  }
  return print;
}

std::vector<Print> prints_on(const Zone& zone, std::size_t surface, std::size_t first_body) {
  const Polygon& polygon = zone.surfaces[surface].polygon;
  const Box2 extent{Vec2(0.0), polygon.size_m()};
  const double gap_m = lies_within_m(zone.surfaces[surface]);
  std::vector<Print> prints;
  for (std::size_t body = first_body; body < zone.surfaces.size(); ++body) {
    auto print = print_on(polygon.frame(), zone.surfaces[body].polygon, gap_m);
    if (print && print->box.meets(extent)) prints.push_back(std::move(*print));
  }
  return prints;
}

Region2 free_of(const Ring2& outline, const Box2& box, const std::vector<Print>& prints) {
  Region2 free = {outline};
  for (const auto& print : prints) {
    if (print.box.meets(box)) free = clip_difference(free, print.region);
  }
  return free;
}

}  // namespace

double lies_within_m(const Surface& surface) {
  constexpr double kGapPerCell = 0.1;
  return std::max(kTouches_m, kGapPerCell * surface.cell_m);
}

void leave_free_of_bodies(Cells& cells, const Zone& zone, std::size_t first_body) {
  Ring2 outline;
  for (std::size_t s = 0; s < first_body; ++s) {
    const auto prints = prints_on(zone, s, first_body);
    if (prints.empty()) continue;
    for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
      cells.outline(i, outline);
      AreaSampler free(free_of(outline, {cells[i].low, cells[i].high}, prints));
      const double share = free.area() / cells[i].area_m2;
      if (share <= kLeastShare)
        cells.cover(i);
      else if (share < 1.0 - kLeastShare)
        cells.leave_free(i, std::move(free));
    }
  }
}

}  // namespace dim
