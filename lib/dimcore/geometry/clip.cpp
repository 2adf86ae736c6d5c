#include "geometry/clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "base/error.hpp"

namespace dim {
namespace {

using ClipperLib::cInt;

// Between the plane's coordinates and Clipper's whole numbers. Remembers the operands' corners, so that those
// that come out of an operation unchanged come out with every digit.
class IntegerGrid {
 public:
  IntegerGrid(const Region2& a, const Region2& b) {
    Vec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const auto* region : {&a, &b}) {
      for (const auto& ring : *region)
        for (const auto& p : ring) low = glm::min(low, p), high = glm::max(high, p);
    }
    centre_ = low + (high - low) / 2.0;
    const double half = std::max((high - low).x, (high - low).y) / 2.0;
    scale_ = half > 0.0 ? std::ldexp(1.0, 50) / half : 1.0;
  }

  ClipperLib::Paths to_grid(const Region2& region) {
    ClipperLib::Paths paths;
    for (const auto& ring : region) {
      ClipperLib::Path path;
      for (const auto& p : ring) {
        const Vec2 q = (p - centre_) * scale_;
        path.emplace_back(static_cast<cInt>(std::llround(q.x)), static_cast<cInt>(std::llround(q.y)));
        corners_.emplace(std::pair(path.back().X, path.back().Y), p);
      }
      paths.push_back(std::move(path));
    }
    return paths;
  }

  double to_grid_length(double length) const { return length * scale_; }

  Region2 from_grid(const ClipperLib::Paths& paths) const {
    Region2 region;
    for (const auto& path : paths) {
      Ring2 ring;
      for (const auto& p : path) {
        const auto corner = corners_.find({p.X, p.Y});
        ring.push_back(corner != corners_.end()
                           ? corner->second
                           : centre_ + Vec2(static_cast<double>(p.X), static_cast<double>(p.Y)) / scale_);
      }
      if (ring.size() >= 3) region.push_back(std::move(ring));
    }
    return region;
  }

 private:
  Vec2 centre_{0.0};
  double scale_ = 1.0;
  std::map<std::pair<cInt, cInt>, Vec2> corners_;
};

Region2 clip(const Region2& subject, const Region2& other, ClipperLib::ClipType type) {
  if (subject.empty()) return {};
  if (other.empty()) return type == ClipperLib::ctDifference ? subject : Region2{};
  IntegerGrid grid(subject, other);
  ClipperLib::Clipper clipper;
  clipper.AddPaths(grid.to_grid(subject), ClipperLib::ptSubject, true);
  clipper.AddPaths(grid.to_grid(other), ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  if (!clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero))
    throw InternalError("polygon clipping failed");
  return grid.from_grid(result);
}

struct Foot {
  double distance;
  Vec2 point;
  double t;
};

Foot foot_on_edge(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  const Vec2 foot = a + t * ab;
  return {glm::length(p - foot), foot, t};
}

Vec2 snapped_corner(const Vec2& p, const Region2& onto, double tolerance) {
  double nearest = tolerance;
  Vec2 result = p;
  for (const auto& ring : onto) {
    for (const auto& q : ring) {
      const double distance = glm::length(p - q);
      if (distance <= nearest) nearest = distance, result = q;
    }
  }
  if (result != p || nearest == 0.0) return result;
  nearest = tolerance;
  for (const auto& ring : onto) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Foot foot = foot_on_edge(p, ring[j], ring[i]);
      if (foot.distance <= nearest) nearest = foot.distance, result = foot.point;
    }
  }
  return result;
}

// Corners of `onto` strictly between a and b and within tolerance of the edge, in order from a.
Ring2 corners_on_edge(const Vec2& a, const Vec2& b, const Region2& onto, double tolerance) {
  std::vector<std::pair<double, Vec2>> found;
  for (const auto& ring : onto) {
    for (const auto& q : ring) {
      if (glm::length(q - a) <= tolerance || glm::length(q - b) <= tolerance) continue;
      const Foot foot = foot_on_edge(q, a, b);
      if (foot.distance <= tolerance && foot.t > 0.0 && foot.t < 1.0) found.emplace_back(foot.t, q);
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  Ring2 result;
  for (const auto& [t, q] : found) result.push_back(q);
  return result;
}

double length_around(const Ring2& ring) {
  double sum = 0.0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    sum += glm::length(ring[i] - ring[j]);
  return sum;
}

}  // namespace

Region2 clip_difference(const Region2& subject, const Region2& clip_region) {
  return clip(subject, clip_region, ClipperLib::ctDifference);
}

Region2 clip_intersection(const Region2& subject, const Region2& clip_region) {
  return clip(subject, clip_region, ClipperLib::ctIntersection);
}

Region2 grown(const Region2& region, double width) {
  constexpr double kMiter = 2.0;
  if (region.empty() || !(width > 0.0)) return region;
  Vec2 low = region.front().front(), high = low;
  for (const auto& ring : region)
    for (const auto& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  const Vec2 reach(kMiter * width);
  IntegerGrid grid(region, {{low - reach, high + reach}});
  ClipperLib::ClipperOffset offset(kMiter);
  offset.AddPaths(grid.to_grid(region), ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  offset.Execute(result, grid.to_grid_length(width));
  return grid.from_grid(result);
}

Region2 projected(const Polygon& polygon, const Frame& onto) {
  Region2 region;
  for (const Ring3& corners : polygon.corners()) {
    Ring2 ring;
    for (const Vec3& corner : corners) ring.push_back(onto.to_local(corner));
    region.push_back(std::move(ring));
  }
  return region;
}

double area(const Region2& region) {
  double sum = 0.0;
  for (const auto& ring : region) sum += signed_area(ring);
  return sum;
}

Region2 snapped(const Region2& region, const Region2& onto, double tolerance) {
  Region2 result;
  for (const auto& ring : region) {
    Ring2 moved;
    for (const auto& p : ring) moved.push_back(snapped_corner(p, onto, tolerance));
    Ring2 noded;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      noded.push_back(moved[i]);
      const Ring2 between = corners_on_edge(moved[i], moved[(i + 1) % moved.size()], onto, tolerance);
      noded.insert(noded.end(), between.begin(), between.end());
    }
    result.push_back(std::move(noded));
  }
  return result;
}

Region2 without_slivers(Region2 region, double width) {
  std::erase_if(region, [width](const Ring2& ring) {
    return 2.0 * std::abs(signed_area(ring)) <= width * length_around(ring);
  });
  return region;
}

}  // namespace dim
