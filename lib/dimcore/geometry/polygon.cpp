#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace dim {
namespace {

// Of two directions, the one that comes first whatever corner the ring starts at: opposite sides of a
// rectangle are equally long, and the choice between them must not depend on the order of listing.
bool precedes(const Vec3& a, const Vec3& b) {
  constexpr double kSame = 1e-9;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(a[axis] - b[axis]) > kSame) return a[axis] > b[axis];
  }
  return false;
}

Vec3 longest_edge_direction(const Ring3& ring) {
  constexpr double kSameLength = 1e-9;
  double longest = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    longest = std::max(longest, glm::length(ring[(i + 1) % ring.size()] - ring[i]));
  Vec3 best(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 edge = ring[(i + 1) % ring.size()] - ring[i];
    const double length = glm::length(edge);
    if (length < longest * (1.0 - kSameLength)) continue;
    const Vec3 direction = edge / length;
    if (best == Vec3(0.0) || precedes(direction, best)) best = direction;
  }
  return best;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * ab));
}

bool inside_even_odd(const Vec2& p, const std::vector<Ring2>& rings) {
  bool inside = false;
  for (const auto& ring : rings) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2& a = ring[i];
      const Vec2& b = ring[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
  }
  return inside;
}

Vec3 mean(const Ring3& ring) {
  Vec3 sum(0.0);
  for (const auto& p : ring) sum += p;
  return sum / static_cast<double>(ring.size());
}

}  // namespace

Vec3 newell(const Ring3& ring) {
  Vec3 sum(0.0);
  if (ring.empty()) return sum;
  const Vec3 origin = ring[0];  // near the ring, so that a room far from the origin loses no digits
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += glm::cross(ring[i] - origin, ring[(i + 1) % ring.size()] - origin);
  return sum;
}

double planarity_error_m(const Ring3& ring) {
  const Vec3 normal = newell(ring);
  const double length = glm::length(normal);
  if (length == 0.0) return 0.0;
  const Vec3 centre = mean(ring);
  double worst = 0.0;
  for (const auto& p : ring) worst = std::max(worst, std::abs(glm::dot(p - centre, normal) / length));
  return worst;
}

std::array<double, 3> area_moments(const Ring2& ring) {
  double area = 0.0, mx = 0.0, my = 0.0;
  if (ring.empty()) return {0.0, 0.0, 0.0};
  const Vec2 o = ring[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - o, b = ring[(i + 1) % ring.size()] - o;
    const double cross = a.x * b.y - b.x * a.y;
    area += cross / 2.0;
    mx += cross * (a.x + b.x) / 6.0;
    my += cross * (a.y + b.y) / 6.0;
  }
  return {area, mx + o.x * area, my + o.y * area};
}

double signed_area(const Ring2& ring) { return area_moments(ring)[0]; }

Polygon::Polygon(const Ring3& outline, const std::vector<Ring3>& holes) {
  const Vec3 normal = newell(outline);
  if (outline.size() < 3 || glm::length(normal) == 0.0)
    throw InternalError("polygon of zero area reached the geometry");
  frame_.origin = mean(outline);
  frame_.n = glm::normalize(normal);
  const Vec3 edge = longest_edge_direction(outline);
  frame_.u = glm::normalize(edge - glm::dot(edge, frame_.n) * frame_.n);
  frame_.v = glm::cross(frame_.n, frame_.u);
  const auto add_ring = [this](const Ring3& ring, bool counter_clockwise) {
    Ring2 flat;
    flat.reserve(ring.size());
    for (const auto& p : ring) flat.push_back(frame_.to_local(p));
    if ((signed_area(flat) > 0.0) != counter_clockwise) std::reverse(flat.begin(), flat.end());
    rings_.push_back(std::move(flat));
  };
  add_ring(outline, true);
  for (const auto& hole : holes) add_ring(hole, false);
  measure();
}

Polygon::Polygon(const Frame& frame, std::vector<Ring2> rings) : frame_(frame), rings_(std::move(rings)) {
  measure();
}

void Polygon::measure() {
  Vec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& ring : rings_) {
    for (const auto& p : ring) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  frame_.origin = frame_.to_world(low);
  size_m_ = high - low;
  double mx = 0.0, my = 0.0;
  area_m2_ = 0.0;
  for (auto& ring : rings_) {
    for (auto& p : ring) p -= low;
    const auto moments = area_moments(ring);
    area_m2_ += moments[0];
    mx += moments[1];
    my += moments[2];
  }
  if (!(area_m2_ > 0.0)) throw InternalError("polygon of zero area reached the geometry");
  centroid_ = {mx / area_m2_, my / area_m2_};
  constexpr double kRectangle = 1e-12;
  is_rectangle_ = rings_.size() == 1 && rings_[0].size() == 4 &&
                  std::abs(size_m_.x * size_m_.y - area_m2_) <= kRectangle * area_m2_;
}

bool Polygon::contains(const Vec2& p, double tolerance_m) const {
  if (p.x < -tolerance_m || p.y < -tolerance_m || p.x > size_m_.x + tolerance_m ||
      p.y > size_m_.y + tolerance_m)
    return false;
  if (is_rectangle_ || inside_even_odd(p, rings_)) return true;
  if (tolerance_m <= 0.0) return false;
  for (const auto& ring : rings_) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      if (distance_to_segment(p, ring[j], ring[i]) <= tolerance_m) return true;
    }
  }
  return false;
}

Polygon Polygon::reversed() const {
  Frame frame = frame_;
  frame.v = -frame_.v;
  frame.n = -frame_.n;
  std::vector<Ring2> rings;
  for (const auto& ring : rings_) {
    Ring2 flipped;
    for (auto it = ring.rbegin(); it != ring.rend(); ++it) flipped.push_back({it->x, -it->y});
    rings.push_back(std::move(flipped));
  }
  return {frame, std::move(rings)};
}

std::vector<Ring3> Polygon::corners() const {
  std::vector<Ring3> result;
  for (const auto& ring : rings_) {
    Ring3 points;
    for (const auto& p : ring) points.push_back(frame_.to_world(p));
    result.push_back(std::move(points));
  }
  return result;
}

}  // namespace dim
