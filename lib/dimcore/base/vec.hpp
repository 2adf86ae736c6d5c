#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace dim {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

inline constexpr double kPi = std::numbers::pi;

inline double radians(double degrees) { return degrees * (kPi / 180.0); }
inline double degrees(double radians_) { return radians_ * (180.0 / kPi); }

inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A unit vector perpendicular to the unit vector `n`.
inline Vec3 perpendicular(const Vec3& n) {
  const Vec3 other = std::abs(n.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return glm::normalize(glm::cross(n, other));
}

}  // namespace dim
