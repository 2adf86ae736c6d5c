#pragma once

#include "light/outside_light.hpp"
#include "sky/sun_position.hpp"

namespace dim {

/// Directions spread evenly over the disc of the sun.
class SunDisc {
 public:
  explicit SunDisc(const SunBeam& sun)
      : n_(sun.towards), u_(perpendicular(sun.towards)), v_(glm::cross(n_, u_)) {}

  /// @param a, b  in [0, 1]
  Vec3 direction(double a, double b) const {
    const double r = std::tan(0.5 * kSunDiameter_rad) * std::sqrt(a), turn = 2.0 * kPi * b;
    return glm::normalize(n_ + r * (std::cos(turn) * u_ + std::sin(turn) * v_));
  }

 private:
  Vec3 n_, u_, v_;
};

}  // namespace dim
