#pragma once

#include "base/vec.hpp"

namespace dim {

/// What a triangle covers of the sphere of directions round a point, and directions spread evenly over it.
class SphericalTriangle {
 public:
  /// @param a, b, c  corners as seen from the point: any length but zero
  SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Steradians, >= 0 (van Oosterom & Strackee 1983).
  double solid_angle_sr() const { return solid_angle_sr_; }

  /// Unit direction for (x, y) in [0, 1) x [0, 1), uniform in solid angle (Arvo 1995, "Stratified sampling of
  /// spherical triangles"). The solid angle must not be zero.
  Vec3 direction(double x, double y) const;

 private:
  Vec3 a_, b_, c_;
  double solid_angle_sr_ = 0.0;
};

}  // namespace dim
