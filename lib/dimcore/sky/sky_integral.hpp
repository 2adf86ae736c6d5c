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

/// Gauss-Legendre points on -1..1, and how far boxes are halved.
struct FineSky {
  static constexpr std::array<double, 5> kNode = {-0.906179845938664, -0.538469310105683, 0.0,
                                                  0.538469310105683, 0.906179845938664};
  static constexpr std::array<double, 5> kWeight = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                                    0.478628670499366, 0.236926885056189};
  static constexpr double kLargest_rad = 0.35;
  static constexpr double kSmallest_rad = 4e-4;
  static constexpr double kHorizon_rad = 0.01;
  static constexpr double kNearness = 0.6;  ///< largest radius of a box against its distance from the sun
};

/// The same for one of many hours: 0.1 % of a patch in a fifth of the time.
struct QuickSky {
  static constexpr std::array<double, 3> kNode = {-0.774596669241483, 0.0, 0.774596669241483};
  static constexpr std::array<double, 3> kWeight = {0.555555555555556, 0.888888888888889, 0.555555555555556};
  static constexpr double kLargest_rad = 0.35;
  static constexpr double kSmallest_rad = 6e-3;
  static constexpr double kHorizon_rad = 0.025;
  static constexpr double kNearness = 0.8;
};

namespace sky_integral {

/// Whether one rule of points is too coarse: near the sun, whose aureole has a cusp, near the horizon, where
/// gradations bend, and in large boxes.
template <typename Rule>
bool too_coarse(const SkyBox& box, double half_height, double half_width, const Vec3& middle,
                const Vec3& sun) {
  const double radius = std::hypot(half_height, half_width);
  if (radius > Rule::kLargest_rad) return true;
  if (box.high_rad > 2.0 * std::max(box.low_rad, Rule::kHorizon_rad) && half_height > Rule::kHorizon_rad)
    return true;
  return radius > Rule::kSmallest_rad && radius > Rule::kNearness * glm::length(middle - sun);
}

/// Both halves of a box: across the longer side, near the horizon always into an upper and a lower one.
inline std::array<SkyBox, 2> halves(const SkyBox& box, bool by_altitude) {
  std::array<SkyBox, 2> half = {box, box};
  if (by_altitude)
    half[0].high_rad = half[1].low_rad = 0.5 * (box.low_rad + box.high_rad);
  else
    half[0].last_rad = half[1].first_rad = 0.5 * (box.first_rad + box.last_rad);
  return half;
}

template <typename Rule, typename Function>
void add_points(const SkyBox& box, const Function& function, SkySums& sums) {
  const double altitude = 0.5 * (box.low_rad + box.high_rad),
               half_altitude = 0.5 * (box.high_rad - box.low_rad);
  const double turn = 0.5 * (box.first_rad + box.last_rad), half_turn = 0.5 * (box.last_rad - box.first_rad);
  constexpr std::size_t kN = Rule::kNode.size();
  std::array<Vec2, kN> level;
  for (std::size_t j = 0; j < kN; ++j) {
    const double t = turn + half_turn * Rule::kNode[j];
    level[j] = Vec2(std::cos(t), std::sin(t));
  }
  for (std::size_t i = 0; i < kN; ++i) {
    const double h = altitude + half_altitude * Rule::kNode[i];
    const double sine = std::sin(h), cosine = std::cos(h);
    double row = 0.0;
    for (std::size_t j = 0; j < kN; ++j)
      row += Rule::kWeight[j] * function(Vec3(cosine * level[j].x, cosine * level[j].y, sine));
    row *= Rule::kWeight[i] * half_altitude * half_turn * cosine;
    sums.sr += row;
    sums.horizontal_sr += row * sine;
    sums.cylinder_sr += row * cosine;
  }
}

template <typename Rule, typename Function>
void add(const SkyBox& box, const Vec3& sun, const Function& function, SkySums& sums) {
  const double altitude = 0.5 * (box.low_rad + box.high_rad), turn = 0.5 * (box.first_rad + box.last_rad);
  const double half_height = 0.5 * (box.high_rad - box.low_rad);
  const double half_width = 0.5 * (box.last_rad - box.first_rad) * std::cos(box.low_rad);
  const double level = std::cos(altitude);
  const Vec3 middle(level * std::cos(turn), level * std::sin(turn), std::sin(altitude));
  if (!too_coarse<Rule>(box, half_height, half_width, middle, sun))
    return add_points<Rule>(box, function, sums);
  const bool at_horizon = box.high_rad > 2.0 * std::max(box.low_rad, Rule::kHorizon_rad);
  for (const auto& half : halves(box, half_height > half_width || at_horizon))
    add<Rule>(half, sun, function, sums);
}

}  // namespace sky_integral

/// Integrates a function of direction, smooth but for a cusp at the sun, over a part of the sky: Gauss points
/// in boxes that are halved towards the sun and the horizon.
/// @param function  Vec3 -> double
template <typename Rule, typename Function>
SkySums integrate_sky(const SkyBox& box, const Vec3& sun, const Function& function) {
  SkySums sums;
  sky_integral::add<Rule>(box, sun, function, sums);
  return sums;
}

}  // namespace dim
