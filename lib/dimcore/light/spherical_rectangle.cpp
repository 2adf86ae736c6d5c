#include "light/spherical_rectangle.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

SphericalRectangle::SphericalRectangle(const Frame& frame, const Vec2& low, const Vec2& high, const Vec3& eye)
    : foot_(frame.to_local(eye)), low_(low - foot_), high_(high - foot_), height_m_(frame.height(eye)) {
  if (!(height_m_ > 0.0)) return;
  const double h = height_m_;
  const auto corner = [h](double x, double y) {
    return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h));
  };
  solid_angle_sr_ = std::max(0.0, corner(high_.x, high_.y) - corner(low_.x, high_.y) -
                                      corner(high_.x, low_.y) + corner(low_.x, low_.y));
  const Vec3 v00(low_.x, low_.y, -h), v10(high_.x, low_.y, -h), v11(high_.x, high_.y, -h),
      v01(low_.x, high_.y, -h);
  const Vec3 n0 = glm::normalize(glm::cross(v00, v10)), n1 = glm::normalize(glm::cross(v10, v11)),
             n2 = glm::normalize(glm::cross(v11, v01)), n3 = glm::normalize(glm::cross(v01, v00));
  b0_ = n0.z;
  b1_ = n2.z;
  k_ = 2.0 * kPi - angle_between(n2, n3) - angle_between(n3, n0);
  excess_ = angle_between(n0, n1) + angle_between(n1, n2) - k_;
}

Vec2 SphericalRectangle::sample(double s, double t) const {
  // The angle about the y axis that holds the share s, then the height along the great circle there.
  const double a = s * excess_ + k_, sine = std::sin(a);
  const double f = sine != 0.0 ? (std::cos(a) * b0_ - b1_) / sine : 0.0;
  const double c = std::clamp(std::copysign(1.0 / std::sqrt(f * f + b0_ * b0_), f), -1.0, 1.0);
  const double x = std::clamp(c * height_m_ / std::sqrt(std::max(1e-300, 1.0 - c * c)), low_.x, high_.x);
  const double d = std::hypot(x, height_m_);
  const double h0 = low_.y / std::hypot(d, low_.y), h1 = high_.y / std::hypot(d, high_.y);
  const double h = h0 + t * (h1 - h0);
  const double y = std::clamp(h * d / std::sqrt(std::max(1e-300, 1.0 - h * h)), low_.y, high_.y);
  return foot_ + Vec2(x, y);
}

}  // namespace dim
