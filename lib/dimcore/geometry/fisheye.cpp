#include "geometry/fisheye.hpp"

#include <cmath>

namespace dim {

Fisheye::Fisheye(const Vec3& eye, const Vec3& forward, const Vec3& up, FisheyeLaw law, int side_px)
    : eye_(eye), forward_(forward), right_(glm::cross(forward, up)), up_(up), law_(law), radius_px_(side_px / 2.0) {}

std::optional<Vec3> Fisheye::direction(double px, double py) const {
  const double x = px / radius_px_ - 1.0, y = 1.0 - py / radius_px_, r = std::hypot(x, y);
  if (!(r < 1.0)) return {};
  const Vec3 across = x * right_ + y * up_;
  if (law_ == FisheyeLaw::hemispherical) return glm::normalize(across + std::sqrt(1.0 - r * r) * forward_);
  const double angle = 0.5 * kPi * r;
  const double sine_by_r = r > 0.0 ? std::sin(angle) / r : 0.5 * kPi;
  return std::cos(angle) * forward_ + sine_by_r * across;
}

double Fisheye::solid_angle_sr(double px, double py) const {
  const double r = std::hypot(px - radius_px_, py - radius_px_) / radius_px_;
  const double pixel = 1.0 / (radius_px_ * radius_px_);  // of the circle of radius 1
  if (law_ == FisheyeLaw::hemispherical) return pixel / std::sqrt(1.0 - r * r);
  return pixel * 0.5 * kPi * (r > 0.0 ? std::sin(0.5 * kPi * r) / r : 0.5 * kPi);
}

std::optional<Vec2> Fisheye::project(const Vec3& point) const {
  const Vec3 p = point - eye_;
  const double x = glm::dot(p, right_), y = glm::dot(p, up_), z = glm::dot(p, forward_), across = std::hypot(x, y);
  const double length = std::hypot(across, z);
  constexpr double kRounding = 1e-12;  // what an edge is cut off at lies on the rim
  if (!(length > 0.0) || z < -kRounding * length) return {};
  if (!(across > 0.0)) return Vec2(radius_px_);
  const double r = law_ == FisheyeLaw::hemispherical ? across / length : std::atan2(across, z) / (0.5 * kPi);
  const double scale = radius_px_ * r / across;
  return Vec2(radius_px_ + scale * x, radius_px_ - scale * y);
}

}  // namespace dim
