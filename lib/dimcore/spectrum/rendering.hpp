#pragma once

#include <array>

#include "base/vec.hpp"
#include "spectrum/curve.hpp"
#include "spectrum/tables/colour_samples.hpp"

/// What a light does for colours and for the body clock: CIE Ra and melanopic equivalent daylight.
namespace dim {

/// Integrals of a light's spectrum from which all its figures follow. Linear: mixtures add.
struct LightResponses {
  double power = 0.0;                          ///< int S
  Vec3 xyz{0.0};                               ///< int S (x, y, z), CIE 1931
  std::array<Vec3, kColourSamples> samples{};  ///< the same of each test colour sample lit by it
  double melanopic = 0.0;                      ///< int S s_mel

  void add(const LightResponses& other, double factor);
};

/// Integrals over [low_nm, high_nm], summed as band_weights does.
LightResponses light_responses(const SpectralCurve& spd, double low_nm, double high_nm);
/// Over the visible range.
LightResponses light_responses(const SpectralCurve& spd);

/// Colour rendering by CIE 13.3-1995: test colour samples under the light and under a reference of its
/// correlated colour temperature, a black body below 5000 K, else CIE daylight.
struct ColourRendering {
  double ra = 0.0;                         ///< mean of R1..R8
  std::array<double, kColourSamples> r{};  ///< R1..R9
};
/// NaN throughout where the light has no correlated colour temperature (white_point), or one beyond that of
/// CIE daylight. CIE 13.3 calls figures of lights with |duv| > 0.0054 less meaningful; they are given all the
/// same.
ColourRendering colour_rendering(const LightResponses& light);
/// The same where the light's temperature is known already.
ColourRendering colour_rendering(const LightResponses& light, double cct_K);

/// Melanopic irradiance of 1 lx of D65, W/lm: 1.3262e-3 (CIE S 026).
double melanopic_efficacy_of_daylight_W_lm();

/// Illuminance of D65 with the same melanopic irradiance (CIE S 026: melanopic EDI).
/// @param melanopic_W_m2  int E s_mel
inline double melanopic_edi_lx(double melanopic_W_m2) {
  return melanopic_W_m2 / melanopic_efficacy_of_daylight_W_lm();
}

}  // namespace dim
