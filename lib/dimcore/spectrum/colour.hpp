#pragma once

#include "base/vec.hpp"

/// Colour coordinates of CIE 15 and the colour difference CIEDE2000.
namespace dim {

/// CIE 1931 (x, y) of XYZ; NaN where there is no light.
Vec2 xy_of(const Vec3& xyz);
/// CIE 1976 (u', v').
Vec2 uv_1976_of(const Vec3& xyz);
/// CIE 1960 (u, v), for correlated colour temperature and Ra only.
Vec2 uv_1960_of(const Vec3& xyz);

/// L*, a*, b* of a colour beside a white (ISO/CIE 11664-4).
struct Lab {
  double l = 0.0, a = 0.0, b = 0.0;
};
/// @param white_xyz  every component > 0, on the scale of `xyz`
Lab lab_of(const Vec3& xyz, const Vec3& white_xyz);

/// CIEDE2000 with k_L = k_C = k_H = 1 (ISO/CIE 11664-6; Sharma, Wu and Dalal 2005).
double delta_e_2000(const Lab& one, const Lab& other);

}  // namespace dim
