#include "geometry/spherical_triangle.hpp"

#include <algorithm>

namespace dim {
namespace {

// Unit vector perpendicular to the unit vector `axis` in the plane of both.
Vec3 perpendicular_part(const Vec3& v, const Vec3& axis) {
  const Vec3 rest = v - glm::dot(v, axis) * axis;
  const double length = glm::length(rest);
  return length > 0.0 ? rest / length : perpendicular(axis);
}

double root(double x) { return std::sqrt(std::max(0.0, x)); }

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : a_(glm::normalize(a)), b_(glm::normalize(b)), c_(glm::normalize(c)) {
  const double volume = std::abs(glm::dot(a_, glm::cross(b_, c_)));
  solid_angle_sr_ = 2.0 * std::atan2(volume, 1.0 + glm::dot(a_, b_) + glm::dot(b_, c_) + glm::dot(c_, a_));
}

Vec3 SphericalTriangle::direction(double x, double y) const {
  // Sine and cosine of the angle at a, and of the part of the solid angle wanted less that angle.
  const Vec3 ab = glm::cross(a_, b_), ac = glm::cross(a_, c_);
  const double size = std::sqrt(glm::dot(ab, ab) * glm::dot(ac, ac));
  const double sin_alpha = std::abs(glm::dot(a_, glm::cross(ab, ac))) / size;
  const double cos_alpha = glm::dot(ab, ac) / size;
  const double sin_part = std::sin(x * solid_angle_sr_), cos_part = std::cos(x * solid_angle_sr_);
  const double s = sin_part * cos_alpha - cos_part * sin_alpha;
  const double t = cos_part * cos_alpha + sin_part * sin_alpha;
  const double u = t - cos_alpha;
  const double v = s + sin_alpha * glm::dot(a_, b_);
  const double below = (v * s + u * t) * sin_alpha;
  const double q = below != 0.0 ? std::clamp(((v * t - u * s) * cos_alpha - v) / below, -1.0, 1.0) : 1.0;
  const Vec3 corner = q * a_ + root(1.0 - q * q) * perpendicular_part(c_, a_);
  const double z = 1.0 - y * (1.0 - glm::dot(corner, b_));
  return z * b_ + root(1.0 - z * z) * perpendicular_part(corner, b_);
}

}  // namespace dim
