#pragma once

#include "result/luminous.hpp"
#include "sky/daylight.hpp"

namespace dim {

/// Factors that make daylight coefficients the light of a sky: patches and ramps as in SkyByPatches, the ground by
/// what sky and sun together light it to, the sun as light of the patches around it. Factors of other sources stay, and
/// those of daylight multiply these.
/// @throws InputError  without a place: no coefficients in the database
Mix sky_mix(const LuminanceDatabase& database, const Mix& mix, const Daylight& daylight);

/// Where no sky is asked for: daylight coefficients as those of patches of even luminance, ramps left out.
Mix even_patches(const LuminanceDatabase& database, const Mix& mix);

/// Factors of daylight alone, luminaires and the sun's beam left out: what a daylight factor is made of.
Mix diffuse_daylight(const LuminanceDatabase& database, const Mix& mix);

}  // namespace dim
