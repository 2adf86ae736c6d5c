#include "glare/position_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

constexpr double kMostAside = 3.0;  // T/R, CIE 117
constexpr double kGreatest = 16.0;

double above(double ahead, double aside, double height) {
  const double sigma = degrees(std::atan2(std::hypot(aside, height), ahead));
  const double tau = degrees(std::atan2(aside, height));
  return std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0)) * 1e-3 * sigma +
                  (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
}

double below(double ahead, double aside, double height) {
  constexpr double kNear = 0.6, kFar = 3.0;
  const double r = std::hypot(aside, height) / ahead;
  return 1.0 + (r < kNear ? 0.8 : 1.2) * std::min(r, kFar);
}

// Parts of a direction, in the eye's axes.
struct EyeAxes {
  double ahead, aside, height;
};

EyeAxes eye_axes(const Vec3& towards, const LineOfSight& sight) {
  return {glm::dot(towards, sight.forward), std::abs(glm::dot(towards, glm::cross(sight.forward, sight.up))),
          glm::dot(towards, sight.up)};
}

double guth_index(const EyeAxes& p) {
  return p.height >= 0.0 ? above(p.ahead, p.aside, p.height) : below(p.ahead, p.aside, p.height);
}

}  // namespace

LineOfSight LineOfSight::along(const Vec3& forward, const Vec3& up) {
  constexpr double kAlong = 1e-9;
  LineOfSight sight;
  sight.forward = glm::normalize(forward);
  Vec3 right = glm::cross(sight.forward, up);
  if (!(glm::length(right) > kAlong * glm::length(up))) right = glm::cross(sight.forward, Vec3(0, 1, 0));
  if (!(glm::length(right) > kAlong)) right = perpendicular(sight.forward);
  sight.up = glm::normalize(glm::cross(right, sight.forward));
  return sight;
}

double position_index(const Vec3& towards, const LineOfSight& sight) {
  const EyeAxes p = eye_axes(towards, sight);
  if (!(p.ahead > 0.0) || p.aside > kMostAside * p.ahead) return std::numeric_limits<double>::infinity();
  return guth_index(p);
}

double whole_view_position_index(const Vec3& towards, const LineOfSight& sight) {
  const EyeAxes p = eye_axes(towards, sight);
  return p.ahead > 0.0 ? std::min(guth_index(p), kGreatest) : kGreatest;
}

}  // namespace dim
