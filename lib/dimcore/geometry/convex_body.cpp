#include "geometry/convex_body.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/beam.hpp"

namespace dim {
namespace {

/// Height over the plane; what lies within the tolerance lies in it.
double height(const Frame& plane, const Vec3& p, double touch_m) {
  const double h = plane.height(p);
  return std::abs(h) <= touch_m ? 0.0 : h;
}

bool reaches(const ConvexBody& body, const Frame& plane, double side, double touch_m) {
  for (const auto& face : body.faces)
    for (const auto& p : face)
      if (side * plane.height(p) > touch_m) return true;
  return false;
}

void add_apart(Ring3& ring, const Vec3& p, double touch_m) {
  if (std::none_of(ring.begin(), ring.end(), [&](const Vec3& q) { return glm::length(p - q) <= touch_m; }))
    ring.push_back(p);
}

/// The part of a convex ring in front; empty where nothing of it is.
Ring3 front_of(const Ring3& ring, const Frame& plane, double touch_m) {
  Ring3 front;
  bool any = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double height_a = height(plane, a, touch_m), height_b = height(plane, b, touch_m);
    any |= height_a > 0.0;
    if (height_a >= 0.0) front.push_back(a);
    if (height_a * height_b < 0.0) front.push_back(a + (b - a) * (height_a / (height_a - height_b)));
  }
  return any ? front : Ring3{};
}

void turn_counter_clockwise(Ring3& ring, const Frame& plane) {
  Vec2 middle(0.0);
  for (const auto& p : ring) middle += plane.to_local(p) / static_cast<double>(ring.size());
  const auto angle = [&](const Vec3& p) {
    const Vec2 d = plane.to_local(p) - middle;
    return std::atan2(d.y, d.x);
  };
  std::sort(ring.begin(), ring.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
}

}  // namespace

ConvexBody hull_of(const Polygon& polygon) {
  std::vector<Vec2> corners;
  for (const auto& ring : polygon.rings()) corners.insert(corners.end(), ring.begin(), ring.end());
  Ring3 outline;
  for (const auto& p : convex_hull(std::move(corners))) outline.push_back(polygon.frame().to_world(p));
  return {{outline}};
}

Ring3 section(const ConvexBody& body, const Frame& plane, double touch_m) {
  if (!reaches(body, plane, 1.0, touch_m) || !reaches(body, plane, -1.0, touch_m)) return {};
  Ring3 points;
  for (const auto& face : body.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec3 &a = face[i], &b = face[(i + 1) % face.size()];
      const double height_a = height(plane, a, touch_m), height_b = height(plane, b, touch_m);
      if (height_a == 0.0) add_apart(points, a, touch_m);
      if (height_a * height_b < 0.0) add_apart(points, a + (b - a) * (height_a / (height_a - height_b)), touch_m);
    }
  turn_counter_clockwise(points, plane);
  return points;
}

ConvexBody front_of(const ConvexBody& body, const Frame& plane, double touch_m) {
  if (!reaches(body, plane, -1.0, touch_m)) return body;
  ConvexBody front;
  for (const auto& face : body.faces)
    if (auto part = front_of(face, plane, touch_m); part.size() >= 3) front.faces.push_back(std::move(part));
  if (body.flat() || front.faces.empty()) return front;
  if (auto end = section(body, plane, touch_m); end.size() >= 3) front.faces.push_back(std::move(end));
  return front;
}

Region2 section_region(const Ring3& section, const Frame& plane, double touch_m) {
  Ring2 ring;
  for (const auto& p : section) ring.push_back(plane.to_local(p));
  if (ring.size() == 2) {
    const Vec2 along = ring[1] - ring[0];
    const Vec2 aside = 1.5 * touch_m / glm::length(along) * Vec2{along.y, -along.x};
    ring = {ring[0] + aside, ring[1] + aside, ring[1] - aside, ring[0] - aside};
  }
  return ring.size() < 3 ? Region2{} : Region2{ring};
}

bool pierces(const Polygon& polygon, const ConvexBody& body, double touch_m) {
  const Frame& plane = polygon.frame();
  const Region2 region = section_region(section(body, plane, touch_m), plane, touch_m);
  return !region.empty() && !without_slivers(clip_intersection(region, polygon.rings()), 2.0 * touch_m).empty();
}

Vec3 middle_of(const ConvexBody& body) {
  Vec3 sum(0.0);
  double n = 0.0;
  for (const auto& face : body.faces)
    for (const auto& p : face) sum += p, n += 1.0;
  return n > 0.0 ? sum / n : sum;
}

}  // namespace dim
