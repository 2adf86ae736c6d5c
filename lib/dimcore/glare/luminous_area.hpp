#pragma once

#include "photometry/opening.hpp"

namespace dim {

/// Luminous area of an opening as it is seen from far away, m2: its projection on a plane across the
/// direction, luminous sides included (CIE 117, CIE 190). 0 for points and lines.
/// @param towards  unit, in the luminaire's frame (x = C0, y = C90, z = aim)
double projected_luminous_area_m2(const LuminousOpening& opening, const Vec3& towards);

}  // namespace dim
