#pragma once

#include <array>
#include <cmath>

#include "base/vec.hpp"

namespace dim {

namespace detail {

/// An eighth of the turn mapped to its place: angle = start + sense * (angle from the nearer axis).
struct Eighth {
  double start;
  double sense;
};

/// atan2 on the eighth numbered `steep + 2 * left + 4 * below`: no branch depends on the direction, which
/// would be mispredicted half the time.
inline double eighths_angle(double ay, double ax, unsigned half) {
  // atan(k/8), k = 0..8: atan(t) = atan(c) + atan((t - c)/(1 + t c)), the second argument at most 1/16.
  static constexpr std::array<double, 9> kAtanEighths = {0.0,
                                                         0.12435499454676144,
                                                         0.24497866312686414,
                                                         0.35877067027057225,
                                                         0.46364760900080609,
                                                         0.55859931534356244,
                                                         0.64350110879328437,
                                                         0.71882999962162453,
                                                         0.78539816339744828};
  static constexpr std::array<Eighth, 8> kEighths = {{{0.0, 1.0},
                                                      {kPi / 2, -1.0},
                                                      {kPi, -1.0},
                                                      {kPi / 2, 1.0},
                                                      {2 * kPi, -1.0},
                                                      {3 * kPi / 2, 1.0},
                                                      {kPi, 1.0},
                                                      {3 * kPi / 2, -1.0}}};
  const double small = ax < ay ? ax : ay;
  const double large = ax > ay ? ax : ay;
  if (!(large > 0.0)) return 0.0;
  const double t = small / large;
  const double scaled = t * 8.0 + 0.5;
  const int k = static_cast<int>(scaled < 8.5 ? scaled : 8.5);
  const double c = k * 0.125;
  const double u = (t - c) / (1.0 + t * c);
  const double u2 = u * u;
  const double tail = 1.0 / 5 + u2 * (-1.0 / 7 + u2 * (1.0 / 9 + u2 * (-1.0 / 11)));
  const double angle = kAtanEighths[static_cast<std::size_t>(k)] + (u + u * u2 * (-1.0 / 3 + u2 * tail));
  const Eighth& eighth = kEighths[static_cast<unsigned>(ay > ax) | half];
  return eighth.start + eighth.sense * angle;
}

}  // namespace detail

/// Angle of (x, y) from the +x axis for y >= 0, in 0..pi; 0 for the zero vector. The vector need not be a
/// unit vector. Absolute error below 1e-15 rad.
///
/// Written out because it is called for every light-source vector and because the C library's own atan2
/// and acos may differ in the last bit between machines with and without fused multiply-add.
inline double half_turn_angle(double y, double x) {
  return detail::eighths_angle(y, std::abs(x), static_cast<unsigned>(x < 0.0) << 1U);
}

/// Angle of (x, y) from +x towards +y in 0..2 pi; 0 for the zero vector.
inline double whole_turn_angle(double y, double x) {
  const unsigned half = static_cast<unsigned>(x < 0.0) << 1U | static_cast<unsigned>(y < 0.0) << 2U;
  return detail::eighths_angle(std::abs(y), std::abs(x), half);
}

}  // namespace dim
