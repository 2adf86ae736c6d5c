#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.hpp"
#include "sky/sky_patches.hpp"

namespace dim {

/// Integrals over a part of the sky.
struct SkySums {
  double sr = 0.0;             ///< of the function
  double horizontal_sr = 0.0;  ///< of the function times sin(altitude)
  double cylinder_sr = 0.0;    ///< of the function times cos(altitude)
};

namespace sky_integral {

// Gauss-Legendre, five points on -1..1.
inline constexpr std::array<double, 5> kNode = {-0.906179845938664, -0.538469310105683, 0.0,
                                                0.538469310105683, 0.906179845938664};
inline constexpr std::array<double, 5> kWeight = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                                  0.478628670499366, 0.236926885056189};
inline constexpr double kLargest_rad = 0.35;
inline constexpr double kSmallest_rad = 4e-4;
inline constexpr double kHorizon_rad = 0.01;

/// Whether one rule of five by five points is too coarse: near the sun, whose aureole has a cusp, near the
/// horizon, where gradations bend, and in large boxes.
inline bool too_coarse(const SkyBox& box, double half_height, double half_width, const Vec3& middle,
                       const Vec3& sun) {
  const double radius = std::hypot(half_height, half_width);
  if (radius > kLargest_rad) return true;
  if (box.high_rad > 2.0 * std::max(box.low_rad, kHorizon_rad) && half_height > kHorizon_rad) return true;
  return radius > kSmallest_rad && radius > 0.6 * glm::length(middle - sun);
}

template <typename Function>
void add(const SkyBox& box, const Vec3& sun, const Function& function, SkySums& sums) {
  const double altitude = 0.5 * (box.low_rad + box.high_rad), turn = 0.5 * (box.first_rad + box.last_rad);
  const double half_altitude = 0.5 * (box.high_rad - box.low_rad);
  const double half_turn = 0.5 * (box.last_rad - box.first_rad);
  const double level = std::cos(altitude);
  const Vec3 middle(level * std::cos(turn), level * std::sin(turn), std::sin(altitude));
  const double half_width = half_turn * std::cos(box.low_rad);
  if (too_coarse(box, half_altitude, half_width, middle, sun)) {
    const bool by_altitude =
        half_altitude > half_width || box.high_rad > 2.0 * std::max(box.low_rad, kHorizon_rad);
    SkyBox lower = box, upper = box;
    if (by_altitude)
      lower.high_rad = upper.low_rad = altitude;
    else
      lower.last_rad = upper.first_rad = turn;
    add(lower, sun, function, sums);
    add(upper, sun, function, sums);
    return;
  }
  for (std::size_t i = 0; i < kNode.size(); ++i) {
    const double h = altitude + half_altitude * kNode[i];
    const double sine = std::sin(h), cosine = std::cos(h);
    double row = 0.0;
    for (std::size_t j = 0; j < kNode.size(); ++j) {
      const double t = turn + half_turn * kNode[j];
      row += kWeight[j] * function(Vec3(cosine * std::cos(t), cosine * std::sin(t), sine));
    }
    row *= kWeight[i] * half_altitude * half_turn * cosine;
    sums.sr += row;
    sums.horizontal_sr += row * sine;
    sums.cylinder_sr += row * cosine;
  }
}

}  // namespace sky_integral

/// Integrates a function of direction, smooth but for a cusp at the sun, over a part of the sky: five by five
/// Gauss points in boxes halved towards the sun and the horizon.
/// @param function  Vec3 -> double
template <typename Function>
SkySums integrate_sky(const SkyBox& box, const Vec3& sun, const Function& function) {
  SkySums sums;
  sky_integral::add(box, sun, function, sums);
  return sums;
}

}  // namespace dim
