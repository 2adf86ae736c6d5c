#pragma once

#include "base/vec.hpp"
#include "spectrum/curve.hpp"

/// Whites: black bodies, daylight, and how near to them the colour of a light is.
namespace dim {

/// Second radiation constant that colour temperatures are stated with (ITS-90, CIE 15), m K.
inline constexpr double kSecondRadiationConstant_m_K = 1.4388e-2;
/// Range of black bodies and of correlated colour temperatures, K.
inline constexpr double kCoolestWhite_K = 1000.0;
inline constexpr double kHottestWhite_K = 100000.0;
/// The CIE daylight series.
inline constexpr double kCoolestDaylight_K = 4000.0;
inline constexpr double kHottestDaylight_K = 25000.0;

/// Planck's law, 1 at 560 nm, every 5 nm.
/// @param temperature_K  at least 1000
SpectralCurve blackbody(double temperature_K);

/// CIE daylight of a correlated colour temperature (CIE 15: chromaticity of the locus, S0 + M1 S1 + M2 S2;
/// M1 and M2 not rounded). "6500 K" of D65 is 6503.6 here: the radiation constant has changed since.
/// @param cct_K  4000..25000
SpectralCurve cie_daylight(double cct_K);

/// Correlated colour temperature and distance from the Planckian locus.
struct WhitePoint {
  double cct_K = 0.0;  ///< NaN where |duv| > 0.05, where CIE 15 defines none, or beyond 1000..100000 K
  double duv = 0.0;    ///< in CIE 1960 (u, v), positive above the locus; NaN without light
};

/// The nearest point of the Planckian locus in CIE 1960 (u, v), searched on the locus itself (CIE 15), which
/// is summed over 360..830 nm every 5 nm.
/// @param xyz  CIE 1931
WhitePoint white_point(const Vec3& xyz);

/// Largest |duv| for which CIE 15 defines a correlated colour temperature.
inline constexpr double kLargestDuv = 0.05;

}  // namespace dim
