#pragma once

#include "base/vec.hpp"
#include "geometry/polygon.hpp"

namespace dim {

/// A rectangle as it is seen from a point: its solid angle, and points of it that are spread evenly over that
/// solid angle (Urena, Fajardo & King 2013), however close it is.
class SphericalRectangle {
 public:
  /// The rectangle [low, high] of the plane of `frame`, seen from `eye`.
  SphericalRectangle(const Frame& frame, const Vec2& low, const Vec2& high, const Vec3& eye);

  /// sr; zero where the eye lies in the plane or behind it (against frame.n).
  double solid_angle_sr() const { return solid_angle_sr_; }

  /// The point that belongs to (s, t) of the unit square, in the frame's plane. Equal areas of the square go
  /// to equal solid angles.
  Vec2 sample(double s, double t) const;

 private:
  Vec2 foot_;        // of the eye on the plane
  Vec2 low_, high_;  // relative to the foot
  double height_m_;
  double solid_angle_sr_ = 0.0;
  double b0_ = 0.0, b1_ = 0.0, k_ = 0.0, excess_ = 0.0;
};

}  // namespace dim
