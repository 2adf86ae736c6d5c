#include "geometry/perspective.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"

namespace dim {

Vec3 upright(const Vec3& forward, const Vec3& up) {
  constexpr double kAlong = 1e-9;
  for (const Vec3& candidate : {up, Vec3(0, 1, 0), Vec3(1, 0, 0)}) {
    const double length = glm::length(candidate);
    if (!(length > 0.0)) continue;
    const Vec3 right = glm::cross(forward, candidate / length);
    if (glm::length(right) > kAlong) return glm::normalize(glm::cross(right, forward));
  }
  throw InternalError("camera without an upright direction reached the geometry");
}

Perspective::Perspective(const Camera& camera)
    : eye_(camera.eye), width_(camera.width), height_(camera.height) {
  const Vec3 view = camera.focus - camera.eye;
  const double length = glm::length(view);
  parallel_ = camera.parallel_m > 0.0;
  const bool wide = parallel_ ? std::isfinite(camera.parallel_m) : camera.fov_rad > 0.0 && camera.fov_rad < kPi;
  if (!(length > 0.0) || !std::isfinite(length) || !wide || width_ < 1 || height_ < 1)
    throw InternalError("camera without a view reached the geometry");
  forward_ = view / length;
  up_ = upright(forward_, camera.up);
  right_ = glm::cross(forward_, up_);
  focal_px_ = parallel_ ? width_ / camera.parallel_m : width_ / 2.0 / std::tan(camera.fov_rad / 2.0);
}

Vec3 Perspective::origin(double px, double py) const {
  if (!parallel_) return eye_;
  return eye_ + ((px - width_ / 2.0) * right_ + (height_ / 2.0 - py) * up_) / focal_px_;
}

Vec3 Perspective::direction(double px, double py) const {
  if (parallel_) return forward_;
  return glm::normalize(focal_px_ * forward_ + (px - width_ / 2.0) * right_ + (height_ / 2.0 - py) * up_);
}

Vec2 Perspective::at_depth(const Vec3& point, double depth_m) const {
  const Vec3 p = point - eye_;
  const double along = parallel_ ? 1.0 : depth_m;
  return {width_ / 2.0 + focal_px_ * (glm::dot(p, right_) / along),
          height_ / 2.0 - focal_px_ * (glm::dot(p, up_) / along)};
}

std::optional<Vec2> Perspective::project(const Vec3& point, double near_m) const {
  const double depth = depth_m(point);
  if (!(depth > 0.0) || depth < near_m) return {};
  return at_depth(point, depth);
}

std::optional<std::pair<double, double>> Perspective::clip(const Vec3& a, const Vec3& b,
                                                           double near_m) const {
  const double side = width_ / 2.0 / focal_px_, top = height_ / 2.0 / focal_px_;
  // Signed distances, up to a factor, from the five planes that bound what the picture shows.
  const auto inside = [&](const Vec3& point) -> std::array<double, 5> {
    const Vec3 p = point - eye_;
    const double x = glm::dot(p, right_), y = glm::dot(p, up_), z = glm::dot(p, forward_);
    const double along = parallel_ ? 1.0 : z;
    return {z - near_m, side * along - x, side * along + x, top * along - y, top * along + y};
  };
  const auto from = inside(a), to = inside(b);
  double start = 0.0, end = 1.0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (from[k] < 0.0 && to[k] < 0.0) return {};
    const double crossing = from[k] / (from[k] - to[k]);
    if (from[k] < 0.0) start = std::max(start, crossing);
    if (to[k] < 0.0) end = std::min(end, crossing);
  }
  if (!(start < end)) return {};
  return std::pair{start, end};
}

}  // namespace dim
