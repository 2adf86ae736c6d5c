#include "scene/joints.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/surface_boxes.hpp"
#include "scene/surface_cut.hpp"

namespace dim {
namespace {

struct Corner {
  Vec2 at{0.0};         // in the plane
  double height = 0.0;  // above it, 0 within the tolerance
};

// The parts of a plane that a polygon fills, where it passes through and where it only touches.
class CrossSection {
 public:
  CrossSection(const Polygon& polygon, const Frame& plane, double touch_m) {
    for (const auto& ring : polygon.rings()) {
      auto& corners = rings_.emplace_back();
      for (const auto& p : ring) {
        const Vec3 world = polygon.frame().to_world(p);
        const double height = plane.height(world);
        corners.push_back({plane.to_local(world), std::abs(height) <= touch_m ? 0.0 : height});
        above_ |= corners.back().height > 0.0;
        below_ |= corners.back().height < 0.0;
        touches_ |= corners.back().height == 0.0;
      }
    }
    along_ = plane.direction_to_local(glm::cross(plane.n, polygon.normal()));
  }

  // What only touches is seen when corners in the plane count as below it, and as above it.
  void add_to(std::vector<Segment2>& segments) const {
    if (!above_ || !(below_ || touches_)) return;
    add_with(false, segments);
    if (touches_ && below_) add_with(true, segments);
  }

 private:
  void add_with(bool touching_is_above, std::vector<Segment2>& segments) const {
    const auto is_above = [&](const Corner& c) {
      return c.height > 0.0 || (c.height == 0.0 && touching_is_above);
    };
    std::vector<Vec2> crossings;
    for (const auto& ring : rings_) {
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Corner &p = ring[j], &q = ring[i];
        if (is_above(p) == is_above(q)) continue;
        crossings.push_back(p.at + (p.height / (p.height - q.height)) * (q.at - p.at));
      }
    }
    const Vec2 along(along_);
    std::sort(crossings.begin(), crossings.end(),
              [&](const Vec2& p, const Vec2& q) { return glm::dot(p, along) < glm::dot(q, along); });
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      segments.push_back({crossings[k], crossings[k + 1]});
  }

  std::vector<std::vector<Corner>> rings_;
  Vec3 along_{0.0};
  bool above_ = false, below_ = false, touches_ = false;
};

// Liang & Barsky 1984.
std::optional<Segment2> within_rectangle(const Segment2& s, const Vec2& size) {
  double from = 0.0, to = 1.0;
  const Vec2 way = s.b - s.a;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0.0) {
      if (s.a[axis] < 0.0 || s.a[axis] > size[axis]) return {};
      continue;
    }
    const double t0 = -s.a[axis] / way[axis], t1 = (size[axis] - s.a[axis]) / way[axis];
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  if (!(from < to)) return {};
  return Segment2{from > 0.0 ? s.a + from * way : s.a, to < 1.0 ? s.a + to * way : s.b};
}

bool runs_along_side(const Segment2& s, const Vec2& size, double touch_m) {
  for (int axis = 0; axis < 2; ++axis) {
    if (std::max(s.a[axis], s.b[axis]) <= touch_m || std::min(s.a[axis], s.b[axis]) >= size[axis] - touch_m)
      return true;
  }
  return false;
}

}  // namespace

std::vector<std::vector<Segment2>> find_joints(const Zone& zone) {
  const auto& surfaces = zone.surfaces;
  std::vector<std::vector<Segment2>> joints(surfaces.size());
  if (surfaces.empty()) return joints;
  const double touch_m = touch_tolerance_m(surfaces);
  const auto boxes = surface_boxes(surfaces);
  const BoxTree tree(boxes);
  const auto find = [&](std::size_t own) {
    const Polygon& polygon = surfaces[own].polygon;
    std::vector<Segment2> segments;
    tree.for_meeting(boxes[own].widened(touch_m), [&](std::size_t other) {
      const Surface& surface = surfaces[other];
      const bool second_side = surface.twin >= 0 && surface.twin < static_cast<int>(other);
      if (other == own || surface.outside || second_side || surface.twin == static_cast<int>(own)) return;
      CrossSection(surface.polygon, polygon.frame(), touch_m).add_to(segments);
    });
    for (const auto& segment : segments) {
      const auto inside = within_rectangle(segment, polygon.size_m());
      if (inside && glm::length(inside->b - inside->a) > touch_m &&
          !runs_along_side(*inside, polygon.size_m(), touch_m))
        joints[own].push_back(*inside);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surfaces.size(), 16), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      if (!surfaces[s].outside) find(s);
    }
  });
  return joints;
}

}  // namespace dim
