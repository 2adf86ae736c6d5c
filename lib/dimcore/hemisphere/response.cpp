#include "hemisphere/response.hpp"

#include <algorithm>
#include <cmath>

#include "hemisphere/turn.hpp"

namespace dim {
namespace {

// {cos, sin} of half of the angle x in 0..2 pi with x - sin(x) = 2 pi share: where a cylinder's weight, sin^2 of the angle
// from its axis, adds up to the share.
Vec2 half_of_cycloid(double share) {
  const bool mirrored = share > 0.5;
  const double due = 2.0 * kPi * (mirrored ? 1.0 - share : share);  // x - sin(x), at most pi
  // x^3/6 = due to first order; Newton's steps then double the digits.
  const double first = std::cbrt(6.0 * due);
  double x = std::min(kPi, first * (1.0 + first * first / 60.0));
  for (int step = 0; step < 3 && x > 0.0; ++step) {
    const double excess = x < 0.1 ? x * x * x * (1.0 / 6 - x * x * (1.0 / 120 - x * x / 5040)) : x - std::sin(x);
    const double half_sine = std::sin(0.5 * x);
    x = std::min(kPi, x - (excess - due) / (2.0 * half_sine * half_sine));
  }
  const Vec2 half = cos_sin_of_turn(std::max(0.0, x) / (4.0 * kPi));
  return {mirrored ? -half.x : half.x, half.y};
}

Vec3 about_normal(double cosine, double turn) {
  const Vec2 azimuth = cos_sin_of_turn(turn);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return {sine * azimuth.x, sine * azimuth.y, cosine};
}

}  // namespace

const std::vector<std::string>& quantity_words() {
  static const std::vector<std::string> words = {"planar", "cylindrical", "semicylindrical", "hemispherical",
                                                 "scalar"};
  return words;
}

double Response::of_body(const Vec3& towards, double along) const {
  switch (quantity) {
    case Quantity::planar:
      break;
    case Quantity::cylindrical:
      return glm::length(glm::cross(towards, normal)) / kPi;
    case Quantity::semicylindrical: {
      const double level = std::hypot(towards.x, towards.y);
      return std::max(0.0, level + towards.x * normal.x + towards.y * normal.y) / kPi;
    }
    case Quantity::hemispherical:
      return 0.25 * std::max(0.0, glm::length(towards) + along);
    case Quantity::scalar:
      return 0.25 * glm::length(towards);
  }
  return std::max(0.0, along);
}

Vec3 response_direction(Quantity quantity, double share, double turn) {
  switch (quantity) {
    case Quantity::planar:
      break;
    case Quantity::cylindrical: {
      const Vec2 polar = half_of_cycloid(share), azimuth = cos_sin_of_turn(turn);
      return {polar.y * azimuth.x, polar.y * azimuth.y, -polar.x};
    }
    case Quantity::semicylindrical: {
      // About the vertical, v, the weight is that of the angle from behind: sin^2 of half of it.
      const Vec2 polar = half_of_cycloid(share), half = half_of_cycloid(turn);
      const Vec2 azimuth(half.y * half.y - half.x * half.x, -2.0 * half.x * half.y);
      return {polar.y * azimuth.y, -polar.x, polar.y * azimuth.x};
    }
    case Quantity::hemispherical:
      return about_normal(2.0 * std::sqrt(share) - 1.0, turn);
    case Quantity::scalar:
      return about_normal(2.0 * share - 1.0, turn);
  }
  return about_normal(std::sqrt(share), turn);
}

}  // namespace dim
