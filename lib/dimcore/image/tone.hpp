#pragma once

#include <cstddef>
#include <optional>

#include "image/colour_space.hpp"
#include "image/raster.hpp"

namespace dim {

/// The automatic exposure: the logarithmic mean of the luminances seen (pixels with Y > 0), the brightest tenth of
/// them left out, is shown at this linear display value. Luminaires usually fill less than a tenth of a view, so
/// that the surfaces decide.
inline constexpr double kAutoKey = 0.35;
/// Where a few bright surfaces stand in the dark: what a tenth of the picture exceeds is at most this many times the
/// display's white.
inline constexpr double kAutoMostAbove = 2.0;
/// Above this share of the display's white, the automatic exposure rolls highlights off: nothing becomes white.
inline constexpr double kShoulder = 0.6;

struct ToneOptions {
  Primaries display = kSrgbPrimaries;
  /// XYZ (any scale) of what is to look neutral; adapted to the display's white (Bradford). Equal-energy by
  /// default, as a fitting without a spectrum is. Set it to the display's white for no adaptation; there is
  /// none either where it is not a colour of the display (neutral_white).
  Vec3 scene_white_xyz = {1, 1, 1};
  /// Luminance shown as the display's white, cd/m2, > 0, everything in proportion; absent:
  /// automatic_display_white_cd_m2, highlights rolled off.
  std::optional<double> display_white_cd_m2 = {};
  /// Spread each value over its two neighbouring 8-bit steps, by a fixed pattern, so that gradients do not
  /// band.
  bool dither = true;
};

struct ToneResult {
  Picture8 picture;
  double display_white_cd_m2 = 0;  ///< the exposure used
  std::size_t n_above_white = 0;   ///< pixels brighter than the display's white
  std::size_t n_out_of_gamut = 0;  ///< pixels whose colour was brought in towards the grey of its luminance
};

/// Luminance that stands for the display's white by the rule above, cd/m2; 1 where nothing is lit.
double automatic_display_white_cd_m2(const Raster& raster);

/// Display luminance of a luminance, both in units of the display's white: itself up to the shoulder k, then
/// k + (1 - k) t / (1 + t) with t = (x - k) / (1 - k): rises for ever with a continuous slope, never to 1.
double rolled_off(double luminance);

/// Linear tone reproduction to sRGB-coded 8 bits: display luminance is proportional to scene luminance up to
/// the display's white, or, where the exposure is automatic, up to the shoulder. Colour: adapted XYZ → primaries (physics.md eq. 17), bring_into_gamut, IEC 61966-2-1.
/// Pixels with a NaN or infinite component are black and not counted.
/// @throws InputError  an exposure that is not finite and > 0; impossible primaries
/// @throws LimitError, InternalError  see check_raster
ToneResult tone_linear(const Raster& raster, const ToneOptions& options = {});

/// Fixed pattern in [0, 1) for dithering, without visible structure at low frequency (interleaved gradient
/// noise, Jimenez 2014).
double dither_threshold(int x, int y);

}  // namespace dim
