#include "geometry/beam.hpp"

#include <algorithm>

namespace dim {
namespace {

constexpr double kNoArea = 1e-12;  // of a ring over the square of its perimeter: nothing but rounding

Ring3 cut(const Ring3& ring, const HalfSpace& limit) {
  Ring3 kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3& a = ring[i];
    const Vec3& b = ring[(i + 1) % ring.size()];
    const double from = limit.height(a), to = limit.height(b);
    if (from >= 0.0) kept.push_back(a);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0))
      kept.push_back(a + from / (from - to) * (b - a));
  }
  return kept;
}

bool has_area(const Ring3& ring) {
  if (ring.size() < 3) return false;
  double perimeter = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    perimeter += glm::length(ring[(i + 1) % ring.size()] - ring[i]);
  return glm::length(newell(ring)) > kNoArea * perimeter * perimeter;
}

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

bool Beam::misses(std::span<const Vec3> corners, double tolerance_m) const {
  return std::any_of(limits.begin(), limits.end(), [&](const HalfSpace& limit) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& p) { return limit.height(p) < -tolerance_m; });
  });
}

Ring3 Beam::part_of(const Ring3& ring) const {
  Ring3 part = ring;
  for (const auto& limit : limits) {
    part = cut(part, limit);
    if (!has_area(part)) return {};
  }
  return part;
}

Beam beam_through(const Ring3& aperture, const Vec3& normal, std::span<const Vec3> opening) {
  Beam beam{{{normal, glm::dot(normal, aperture.front())}}};
  const HalfSpace plane = beam.limits.front();
  for (std::size_t i = 0; i < aperture.size(); ++i) {
    const Vec3& a = aperture[i];
    const Vec3 edge = aperture[(i + 1) % aperture.size()] - a;
    const Vec3 inwards = glm::cross(normal, edge);
    const Vec3* widest = nullptr;
    double most = 0.0;
    bool behind = glm::dot(edge, edge) > 0.0;
    for (const Vec3& q : opening) {
      const double depth_m = -plane.height(q);
      behind = behind && depth_m > 0.0;
      if (!behind) break;
      const double slope = glm::dot(q - a, inwards) / depth_m;
      if (widest && slope <= most) continue;
      widest = &q;
      most = slope;
    }
    if (!behind || !widest) continue;
    Vec3 limit = glm::normalize(glm::cross(edge, *widest - a));
    if (glm::dot(limit, inwards) < 0.0) limit = -limit;
    beam.limits.push_back({limit, glm::dot(limit, a)});
  }
  return beam;
}

// Andrew's monotone chain.
Ring2 convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  Ring2 hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace dim
