#include "geometry/convex_ring.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr double kGauss = 0.28867513459481287;  // half of 1/sqrt(3)

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

void ConvexRing::add(const Vec3& corner) {
  if (n_ == kMostCorners) throw InternalError("a convex ring of more than 40 corners");
  corner_[static_cast<std::size_t>(n_++)] = corner;
}

double ConvexRing::area_m2() const {
  if (n_ < 3) return 0.0;
  Vec3 sum(0.0);
  for (int i = 1; i + 1 < n_; ++i) sum += glm::cross((*this)[i] - (*this)[0], (*this)[i + 1] - (*this)[0]);
  return 0.5 * glm::length(sum);
}

double ConvexRing::measure() const {
  if (n_ == 1) return 1.0;
  return n_ == 2 ? glm::length((*this)[1] - (*this)[0]) : area_m2();
}

Vec3 ConvexRing::middle() const {
  Vec3 sum(0.0);
  for (const Vec3& corner : *this) sum += corner;
  return sum / static_cast<double>(n_);
}

double ConvexRing::radius_m(const Vec3& middle) const {
  double largest2 = 0.0;
  for (const Vec3& corner : *this) largest2 = std::max(largest2, glm::dot(corner - middle, corner - middle));
  return std::sqrt(largest2);
}

bool ConvexRing::is_parallelogram() const {
  if (n_ != 4) return false;
  const Vec3 gap = (*this)[0] - (*this)[1] + (*this)[2] - (*this)[3];
  const Vec3 across = (*this)[2] - (*this)[0];
  return glm::dot(gap, gap) <= 1e-24 * glm::dot(across, across);
}

double ConvexRing::distance_m(const Vec3& p) const {
  if (n_ == 1) return glm::length(p - (*this)[0]);
  double nearest2 = 1e300;
  bool inside = n_ > 2;
  Vec3 normal(0.0);
  if (inside) normal = glm::cross((*this)[1] - (*this)[0], (*this)[n_ - 1] - (*this)[0]);
  for (int i = 0; i < (n_ == 2 ? 1 : n_); ++i) {
    const Vec3 edge = (*this)[(i + 1) % n_] - (*this)[i], from = p - (*this)[i];
    const double length2 = glm::dot(edge, edge);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(from, edge) / length2, 0.0, 1.0) : 0.0;
    const Vec3 off = from - t * edge;
    nearest2 = std::min(nearest2, glm::dot(off, off));
    inside = inside && glm::dot(glm::cross(normal, edge), from) >= 0.0;
  }
  if (inside) return std::abs(glm::dot(normal, p - (*this)[0])) / glm::length(normal);
  return std::sqrt(nearest2);
}

ConvexRing ConvexRing::front_of(const Vec3& normal, double offset) const {
  // A corner in the plane but for rounding is not cut off.
  constexpr double kInPlane = 1e-12;
  std::array<double, kMostCorners> height;
  double lowest = 0.0, highest = 0.0;
  for (int i = 0; i < n_; ++i) {
    height[static_cast<std::size_t>(i)] = glm::dot(normal, (*this)[i]) - offset;
    lowest = std::min(lowest, height[static_cast<std::size_t>(i)]);
    highest = std::max(highest, height[static_cast<std::size_t>(i)]);
  }
  const double in_plane = kInPlane * (highest - lowest);
  if (lowest >= -in_plane) return *this;
  for (int i = 0; i < n_; ++i) {
    double& h = height[static_cast<std::size_t>(i)];
    if (std::abs(h) <= in_plane) h = 0.0;
  }
  ConvexRing front;
  // Of a segment only the step from its first to its second corner exists.
  for (int i = 0; i < n_; ++i) {
    const int j = i == 0 ? n_ - 1 : i - 1;
    const double to = height[static_cast<std::size_t>(i)], from = height[static_cast<std::size_t>(j)];
    if ((from < 0.0) != (to < 0.0) && !(n_ == 2 && i == 0))
      front.add((*this)[j] + (from / (from - to)) * ((*this)[i] - (*this)[j]));
    if (to >= 0.0) front.add((*this)[i]);
  }
  return front.n_ < std::min(n_, 3) ? ConvexRing() : front;
}

std::array<ConvexRing, 2> ConvexRing::halves() const {
  constexpr int kManySided = 8;
  constexpr double kLonger = 1.0 + 1e-9;  // of sides that are equal but for rounding the first one counts
  Vec3 longest(0.0), at(0.0);
  for (int i = 0; i < (n_ == 2 ? 1 : n_); ++i) {
    const int j = n_ > kManySided ? (i + n_ / 2) % n_ : (i + 1) % n_;
    const Vec3 side = (*this)[j] - (*this)[i];
    if (glm::dot(side, side) <= kLonger * glm::dot(longest, longest)) continue;
    longest = side;
    at = 0.5 * ((*this)[i] + (*this)[j]);
  }
  const double offset = glm::dot(longest, n_ == 3 || n_ > kManySided || n_ == 2 ? at : middle());
  return {front_of(longest, offset), front_of(-longest, -offset)};
}

Vec3 ConvexRing::sample(double a, double b) const {
  if (n_ == 1) return (*this)[0];
  if (n_ == 2) return (*this)[0] + a * ((*this)[1] - (*this)[0]);
  if (is_parallelogram())
    return (*this)[0] + a * ((*this)[1] - (*this)[0]) + b * ((*this)[3] - (*this)[0]);
  double left = a * area_m2();
  for (int i = 1; i + 1 < n_; ++i) {
    const double area = triangle_area((*this)[0], (*this)[i], (*this)[i + 1]);
    if (left > area && i + 2 < n_) {
      left -= area;
      continue;
    }
    const double s = std::sqrt(area > 0.0 ? std::clamp(left / area, 0.0, 1.0) : 0.0);
    return (*this)[0] + s * ((1.0 - b) * ((*this)[i] - (*this)[0]) + b * ((*this)[i + 1] - (*this)[0]));
  }
  return (*this)[0];
}

std::array<Vec3, 2> ConvexRing::chord(const Vec3& p, const Vec3& direction) const {
  if (n_ == 2) return {(*this)[0], (*this)[1]};
  // Against each edge the line is inside on one side of its crossing: the nearest crossings are the ends.
  const Vec3 normal = glm::cross((*this)[1] - (*this)[0], (*this)[n_ - 1] - (*this)[0]);
  double low = -1e300, high = 1e300;
  for (int i = 0; i < n_; ++i) {
    const Vec3& from = (*this)[i];
    const Vec3 inwards = glm::cross(normal, (*this)[(i + 1) % n_] - from);
    const double speed = glm::dot(inwards, direction);
    if (speed == 0.0) continue;
    const double t = glm::dot(inwards, from - p) / speed;
    if (speed > 0.0)
      low = std::max(low, std::min(t, 0.0));
    else
      high = std::min(high, std::max(t, 0.0));
  }
  return {p + low * direction, p + high * direction};
}

void ConvexRing::nodes(Nodes& result) const {
  const auto put = [&](const Vec3& at, double weight) {
    result.at[static_cast<std::size_t>(result.n)] = at;
    result.weight[static_cast<std::size_t>(result.n++)] = weight;
  };
  result.n = 0;
  if (n_ == 1) return put((*this)[0], 1.0);
  if (n_ == 2) {
    for (const double s : {0.5 - kGauss, 0.5 + kGauss})
      put((*this)[0] + s * ((*this)[1] - (*this)[0]), 0.5);
    return;
  }
  if (is_parallelogram()) {
    for (const double s : {0.5 - kGauss, 0.5 + kGauss}) {
      for (const double t : {0.5 - kGauss, 0.5 + kGauss})
        put((*this)[0] + s * ((*this)[1] - (*this)[0]) + t * ((*this)[3] - (*this)[0]), 0.25);
    }
    return;
  }
  double total = 0.0;
  for (int i = 1; i + 1 < n_; ++i) {
    const Vec3 a = (*this)[0], b = (*this)[i], c = (*this)[i + 1];
    const double area = triangle_area(a, b, c);
    total += area;
    for (const Vec3& at : {(4.0 * a + b + c) / 6.0, (a + 4.0 * b + c) / 6.0, (a + b + 4.0 * c) / 6.0})
      put(at, area / 3.0);
  }
  for (int i = 0; i < result.n; ++i)
    result.weight[static_cast<std::size_t>(i)] = total > 0.0 ? result.weight[static_cast<std::size_t>(i)] / total
                                                             : 1.0 / result.n;
}

double projected_solid_angle_sr(const ConvexRing& ring, const Vec3& p, const Vec3& n) {
  double sum = 0.0;
  Vec3 from = glm::normalize(ring[ring.size() - 1] - p);
  for (const Vec3& corner : ring) {
    const Vec3 to = glm::normalize(corner - p);
    const Vec3 across = glm::cross(from, to);
    const double sine = glm::length(across);
    // angle / sine tends to 1 for short edges; an edge through p adds nothing that can be told.
    if (sine > 0.0) sum += std::atan2(sine, glm::dot(from, to)) / sine * glm::dot(across, n);
    from = to;
  }
  return std::isfinite(sum) ? 0.5 * std::abs(sum) : 0.0;
}

double solid_angle_sr(const ConvexRing& ring, const Vec3& p) {
  double sum = 0.0;
  const Vec3 a = ring[0] - p;
  const double la = glm::length(a);
  for (int i = 1; i + 1 < ring.size(); ++i) {
    const Vec3 b = ring[i] - p, c = ring[i + 1] - p;
    const double lb = glm::length(b), lc = glm::length(c);
    sum += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                               glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::isfinite(sum) ? std::abs(sum) : 0.0;
}

}  // namespace dim
