#pragma once

#include <cstddef>
#include <optional>

#include "image/colour_space.hpp"
#include "image/raster.hpp"

namespace dim {

/// The automatic exposure: this quantile of the luminances seen (pixels with Y > 0) is shown at this linear
/// display value. Luminaires usually fill less than a tenth of a view, so that the surfaces decide.
inline constexpr double kAutoExposureQuantile = 0.90;
inline constexpr double kAutoExposureShownAt = 0.70;

struct ToneOptions {
  Primaries display = kSrgbPrimaries;
  /// XYZ (any scale) of what is to look neutral; adapted to the display's white (Bradford). Equal-energy by
  /// default, as a fitting without a spectrum is. Set it to the display's white for no adaptation; there is
  /// none either where it is not a colour of the display (neutral_white).
  Vec3 scene_white_xyz = {1, 1, 1};
  /// Luminance shown as the display's white, cd/m2, > 0; absent: automatic_display_white_cd_m2.
  std::optional<double> display_white_cd_m2 = {};
  /// Spread each value over its two neighbouring 8-bit steps, by a fixed pattern, so that gradients do not
  /// band.
  bool dither = true;
};

struct ToneResult {
  Picture8 picture;
  double display_white_cd_m2 = 0;  ///< the exposure used
  std::size_t n_above_white = 0;   ///< pixels brighter than the display's white: shown white
  std::size_t n_out_of_gamut = 0;  ///< pixels whose colour was brought in towards the grey of its luminance
};

/// Luminance to be shown as the display's white by the rule above, cd/m2; 1 where nothing is lit.
double automatic_display_white_cd_m2(const Raster& raster);

/// Linear tone reproduction to sRGB-coded 8 bits: display luminance is proportional to scene luminance up to
/// the display's white. Colour: adapted XYZ → primaries (physics.md eq. 17), bring_into_gamut, IEC 61966-2-1.
/// Pixels with a NaN or infinite component are black and not counted.
/// @throws InputError  an exposure that is not finite and > 0; impossible primaries
/// @throws LimitError, InternalError  see check_raster
ToneResult tone_linear(const Raster& raster, const ToneOptions& options = {});

/// Fixed pattern in [0, 1) for dithering, without visible structure at low frequency (interleaved gradient
/// noise, Jimenez 2014).
double dither_threshold(int x, int y);

}  // namespace dim
