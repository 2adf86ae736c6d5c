#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sky/sky_patches.hpp"

namespace dim {

/// What a point gets from each column of SkyPatches at 1 cd/m2, the windows in one state.
struct DaylightCoefficients {
  int subdivision = 1;              ///< of the sky: 1, 2 or 4
  double ground_reflectance = 0.2;  ///< of the ground that the sky and the sun light
  double north_rad = 0.0;           ///< true north, clockwise from the zone's +y
  std::size_t n_points = 0;
  std::vector<float> total_lx;   ///< [n_columns, n_points]
  std::vector<float> direct_lx;  ///< the same without light reflected inside
};

/// Illuminance by the sun's beam, per lx across it: what of it a point sees, times cosine and transmittance.
/// @param towards  the sun, unit vector of the sky's frame (x east, y north, z up)
/// @param first    point that `factors` begins with
using SunFactors = std::function<void(const Vec3& towards, std::size_t first, std::span<float> factors)>;

/// Factors where only coefficients are known: the beam spread over the patch that the sun is in.
SunFactors spread_sun(const DaylightCoefficients& coefficients);

/// Shares of a sun among patches that stand for the light it sends in: the four whose middles are round it, bilinear
/// in altitude and azimuth.
struct SunShare {
  std::size_t patch = 0;
  double share = 0.0;
};
std::vector<SunShare> sun_shares(const SkyPatches& patches, const Vec3& towards);

}  // namespace dim
