#include "geometry/convex_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {

Line2 line_through(const Segment2& segment) {
  const Vec2 along = glm::normalize(segment.b - segment.a);
  const Vec2 normal(-along.y, along.x);
  return {normal, glm::dot(normal, segment.a + (segment.b - segment.a) / 2.0)};
}

bool passes_through(const Segment2& segment, const Ring2& convex, double rounding_m) {
  const Line2 line = line_through(segment);
  const Vec2 along(line.normal.y, -line.normal.x);
  double left = 0.0, right = 0.0;
  double from = std::numeric_limits<double>::max(), to = std::numeric_limits<double>::lowest();
  double before = line.height(convex.back());
  for (std::size_t i = 0, j = convex.size() - 1; i < convex.size(); j = i++) {
    const double height = line.height(convex[i]);
    left = std::max(left, height);
    right = std::max(right, -height);
    if ((height < 0.0) != (before < 0.0)) {
      const Vec2 crossing = convex[j] + (before / (before - height)) * (convex[i] - convex[j]);
      const double at = glm::dot(crossing - segment.a, along);
      from = std::min(from, at);
      to = std::max(to, at);
    }
    before = height;
  }
  if (left <= rounding_m || right <= rounding_m) return false;
  return std::min(to, glm::length(segment.b - segment.a)) - std::max(from, 0.0) > rounding_m;
}

void split_convex(const Ring2& convex, const Line2& line, double rounding_m, Ring2& left, Ring2& right) {
  left.clear();
  right.clear();
  const auto height = [&](const Vec2& p) {
    const double h = line.height(p);
    return std::abs(h) <= rounding_m ? 0.0 : h;
  };
  double before = height(convex.back());
  for (std::size_t i = 0, j = convex.size() - 1; i < convex.size(); j = i++) {
    const double here = height(convex[i]);
    if (before * here < 0.0) {
      left.push_back(convex[j] + (before / (before - here)) * (convex[i] - convex[j]));
      right.push_back(left.back());
    }
    if (here >= 0.0) left.push_back(convex[i]);
    if (here <= 0.0) right.push_back(convex[i]);
    before = here;
  }
}

double mean_width_m(const Ring2& ring) {
  double around = 0.0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    around += glm::length(ring[i] - ring[j]);
  return around > 0.0 ? 2.0 * std::abs(signed_area(ring)) / around : 0.0;
}

bool segments_meet(const Segment2& s, const Segment2& t) {
  const Line2 on_s = line_through(s), on_t = line_through(t);
  return on_s.height(t.a) * on_s.height(t.b) <= 0.0 && on_t.height(s.a) * on_t.height(s.b) <= 0.0;
}

double distance_m(const Vec2& p, const Segment2& segment) {
  const Vec2 way = segment.b - segment.a;
  const double t = std::clamp(glm::dot(p - segment.a, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::length(p - (segment.a + t * way));
}

}  // namespace dim
