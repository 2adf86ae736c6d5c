#pragma once

#include <array>

#include "geometry/convex_ring.hpp"

namespace dim {

/// The convex hull of two convex rings, as half-spaces that contain it: what can be in the way between them.
class Shaft {
 public:
  /// @param a, b  neither empty
  /// @param skip  plate that the first ring lies on: never in its own way; or -1
  Shaft(const ConvexRing& a, const ConvexRing& b, int skip);

  /// Says that all of the hull has dot(normal, p) >= offset.
  void add_limit(const Vec3& normal, double offset);

  /// Whether a box shares no more than boundary with the hull. False negatives only.
  bool misses(const Vec3& low, const Vec3& high, double tolerance_m) const;

  const ConvexRing& a() const { return a_; }
  const ConvexRing& b() const { return b_; }
  int skip() const { return skip_; }

 private:
  struct Limit {
    Vec3 normal;
    double offset;
  };
  void add_silhouettes(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b);

  ConvexRing a_, b_;
  int skip_;
  Vec3 low_, high_;
  int n_limits_ = 0;
  std::array<Limit, 16> limits_;
};

}  // namespace dim
