#pragma once

#include <optional>

#include "base/vec.hpp"
#include "image/raster.hpp"

/// Brightness mapping: luminances of the scene become luminances of a screen that look as bright.
///
/// Stevens & Stevens 1963 ("Brightness function: effects of adaptation", J. Opt. Soc. Am. 53(3), 375-385),
/// as fitted by Tumblin & Rushmeier 1993 ("Tone reproduction for realistic images", IEEE Comput. Graph.
/// Appl. 13(6), 42-48): an eye adapted to the luminance La sees a luminance L with the brightness B,
///
///   log10 B = alpha log10 L + beta,   B in brils, L and La in lamberts (1 lambert = 10000/pi cd/m2)
///   alpha(La) =  0.4 log10 La + 2.92
///   beta(La)  = -0.4 (log10 La)^2 - 2.584 log10 La + 2.0208
///
/// In the words b = k (L - L0)^c of physics.md (18)-(20): k = 10^beta, c = alpha, L0 = 0.
namespace dim {

inline constexpr double kLambert_cd_m2 = 10000.0 / kPi;

/// Exponent of the dark-adapted eye (Stevens' cube root). Adaptation luminances at which the fit gives less,
/// below about 0.0011 cd/m2, count as the one at which it gives this; the fit itself turns negative further
/// down.
inline constexpr double kDarkAdaptedExponent = 1.0 / 3.0;

/// log10 of a screen's white over the log-mean of a picture on it: a mean reflectance of 14.5 %, the step
/// between adaptation and white in Tumblin & Rushmeier 1993.
inline constexpr double kWhiteOverMean_log10 = 0.84;

/// Brightness seen by an eye in one state of adaptation.
struct BrightnessCurve {
  double alpha = 1.0;
  double beta = 0.0;
};

/// The curve of an eye adapted to a uniform luminance, cd/m2, finite and > 0.
BrightnessCurve stevens_curve(double adaptation_cd_m2);

/// Brightness in brils, >= 0; 0 for a luminance that is not above 0 (NaN included).
double brightness_stevens_bril(double luminance_cd_m2, const BrightnessCurve& curve);

/// Luminance, cd/m2, that looks as bright on the screen as `scene_cd_m2` does in the scene: the scene's curve
/// forwards, the screen's backwards. Increases with scene_cd_m2, is scene_cd_m2 itself where the curves are
/// the same, and 0 for a luminance that is not above 0 (NaN included).
double display_luminance_cd_m2(double scene_cd_m2, const BrightnessCurve& scene,
                               const BrightnessCurve& screen);

/// Geometric mean of the luminances of the pixels that are lit (finite, Y > 0); nothing where none is.
/// @throws LimitError, InternalError  see check_raster
std::optional<double> log_mean_luminance_cd_m2(const Raster& raster);

struct StevensOptions {
  double screen_white_cd_m2 = 100.0;  ///< luminance of the screen's own white, > 0
};

struct StevensResult {
  Raster shown;                        ///< XYZ as the screen is to emit it, cd/m2; no scalar, no radiance
  double scene_adaptation_cd_m2 = 0;   ///< log-mean luminance of the scene; the screen's where nothing is lit
  double screen_adaptation_cd_m2 = 0;  ///< log-mean luminance of a usual picture on the screen
};

/// The scene as it is to be shown: each pixel's luminance by display_luminance_cd_m2, its chromaticity kept.
/// The eye adapts to the log-mean luminance of the view there, and to that of a usual picture on the screen
/// here. (Tumblin & Rushmeier raise both by kWhiteOverMean_log10 before they enter the fit. That is where its
/// curves cross, so that the mean of every scene, moonlit or sunlit, is shown alike. Here the adaptation
/// enters as Stevens measured it, and the mean follows the cube root of the scene's: darker scenes are shown
/// darker.) Pixels with a NaN or infinite component, and those without luminance, become black.
/// @throws InputError                 a screen's white that is not finite and > 0
/// @throws LimitError, InternalError  see check_raster
StevensResult map_brightness(const Raster& raster, const StevensOptions& options = {});

}  // namespace dim
