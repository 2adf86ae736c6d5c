#pragma once

#include <array>
#include <vector>

#include "geometry/convex_ring.hpp"

namespace dim {

/// The solid angle that convex rings in space fill round a point, and directions spread evenly over it: fans of
/// spherical triangles, one after the other.
class SolidAngleFan {
 public:
  explicit SolidAngleFan(const Vec3& eye) : eye_(eye) {}

  void add(const ConvexRing& ring);
  double solid_angle_sr() const { return total_sr_; }
  /// Unit direction for (a, b) in [0, 1] x [0, 1]. The solid angle must not be zero.
  Vec3 direction(double a, double b) const;

 private:
  struct Triangle {
    Vec3 apex, from, to;
    double up_to_sr;
  };
  Vec3 eye_;
  double total_sr_ = 0.0;
  std::vector<Triangle> triangles_;
};

}  // namespace dim
