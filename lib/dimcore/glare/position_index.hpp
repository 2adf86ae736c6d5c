#pragma once

#include "base/vec.hpp"

namespace dim {

/// Which way an eye looks. Unit vectors at right angles.
struct LineOfSight {
  Vec3 forward{1, 0, 0};
  Vec3 up{0, 0, 1};

  /// Looking along `forward` (any length), upright as `up` has it; +y up where it looks along `up`.
  static LineOfSight along(const Vec3& forward, const Vec3& up = {0, 0, 1});
};

/// Guth's position index of a source seen in a direction: 1 on the line of sight, growing with the distance
/// from it. Above the line of sight the formula of Levin (1975; IES Lighting Handbook) for the curves that
/// CIE 117 tabulates,
///   p = exp[(35.2 - 0.31889 tau - 1.22 e^(-2 tau/9)) 1e-3 sigma + (21 + 0.26667 tau - 0.002963 tau^2) 1e-5
///   sigma^2],
/// sigma the angle from the line of sight and tau that of their common plane from the vertical, degrees;
/// below it 1 + 0.8 r for r < 0.6, else 1 + 1.2 r, r = tan(sigma) at most 3 (Iwata & Tokura 1997).
/// @param towards  of the source, not zero
/// @returns infinity where a source does not count: behind the eye, and beyond the table, T/R > 3 to the side
double position_index(const Vec3& towards, const LineOfSight& sight);

/// The same formulas for all that is seen, at most 16, as evalglare has it for daylight: there is no edge of a table.
/// @param towards  of the source, not zero, any length
double whole_view_position_index(const Vec3& towards, const LineOfSight& sight);

}  // namespace dim
