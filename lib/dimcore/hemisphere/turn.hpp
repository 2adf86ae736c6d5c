#pragma once

#include "base/vec.hpp"

namespace dim {

/// {cos, sin} of an angle in turns, 0..1 (1 = a whole turn), to 1e-11; the same bits on every machine.
inline Vec2 cos_sin_of_turn(double turn) {
  const int quarter = static_cast<int>(turn * 4.0 + 0.5);
  const double x = (turn - 0.25 * quarter) * (2.0 * kPi);  // within +-pi/4
  const double x2 = x * x;
  // Taylor series; the first terms left out are below 2e-12 and 2e-11 at pi/4.
  const double sine =
      x * (1.0 + x2 * (-1.0 / 6 +
                       x2 * (1.0 / 120 + x2 * (-1.0 / 5040 + x2 * (1.0 / 362880 + x2 * (-1.0 / 39916800))))));
  const double cosine =
      1.0 +
      x2 * (-0.5 + x2 * (1.0 / 24 + x2 * (-1.0 / 720 + x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 +
                                                                                 x2 * (1.0 / 479001600))))));
  switch (quarter & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace dim
