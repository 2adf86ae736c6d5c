#include "geometry/shaft.hpp"

#include <algorithm>

namespace dim {
namespace {

std::array<Vec3, 2> box_of(const ConvexRing& ring) {
  std::array<Vec3, 2> box{ring[0], ring[0]};
  for (const Vec3& corner : ring) {
    box[0] = glm::min(box[0], corner);
    box[1] = glm::max(box[1], corner);
  }
  return box;
}

}  // namespace

Shaft::Shaft(const ConvexRing& a, const ConvexRing& b, int skip) : a_(a), b_(b), skip_(skip) {
  const auto box_a = box_of(a), box_b = box_of(b);
  low_ = glm::min(box_a[0], box_b[0]);
  high_ = glm::max(box_a[1], box_b[1]);
  add_silhouettes(box_a, box_b);
}

void Shaft::add_limit(const Vec3& normal, double offset) {
  if (n_limits_ < static_cast<int>(limits_.size())) limits_[static_cast<std::size_t>(n_limits_++)] = {normal, offset};
}

// Haines & Wallace 1991: where one box makes one face of the common box and the other box a neighbouring face,
// the plane through their edges bounds the hull of both.
void Shaft::add_silhouettes(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const auto corner = [](const std::array<Vec3, 2>& box, int axis, int side) {
    return box[static_cast<std::size_t>(side)][axis];
  };
  // +1: only a reaches this face of the common box, -1: only b, 0: both.
  const auto maker = [&](int axis, int side) {
    const double sign = side ? 1.0 : -1.0;
    const double reach = sign * (corner(a, axis, side) - corner(b, axis, side));
    return reach > 0.0 ? 1 : (reach < 0.0 ? -1 : 0);
  };
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    for (int si = 0; si < 2; ++si) {
      for (int sj = 0; sj < 2; ++sj) {
        const int mi = maker(i, si), mj = maker(j, sj);
        if (mi * mj >= 0) continue;
        const double ai = corner(a, i, si), aj = corner(a, j, sj), bi = corner(b, i, si), bj = corner(b, j, sj);
        // Normal of the line through (ai, aj) and (bi, bj), turned to point out of the common box's corner.
        Vec3 out(0.0);
        out[i] = bj - aj;
        out[j] = ai - bi;
        if (out[i] * (si ? 1.0 : -1.0) < 0.0) out = -out;
        add_limit(-out, -(out[i] * ai + out[j] * aj));
      }
    }
  }
}

bool Shaft::misses(const Vec3& low, const Vec3& high, double tolerance_m) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] > high_[axis] + tolerance_m || high[axis] < low_[axis] - tolerance_m) return true;
  }
  for (int i = 0; i < n_limits_; ++i) {
    const Limit& limit = limits_[static_cast<std::size_t>(i)];
    const Vec3 farthest(limit.normal.x > 0.0 ? high.x : low.x, limit.normal.y > 0.0 ? high.y : low.y,
                        limit.normal.z > 0.0 ? high.z : low.z);
    if (glm::dot(limit.normal, farthest) < limit.offset) return true;
  }
  return false;
}

}  // namespace dim
