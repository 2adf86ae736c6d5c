#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spectrum/curve.hpp"

namespace dim {

/// The relative spectral power distribution of that name:
///   cie-a c d50 d55 d65 d75 e                         CIE 15 (e: equal energy)
///   fl-1..fl-12 fl3-1..fl3-15 hp-1..hp-5              CIE 15: fluorescent, high-pressure discharge
///   led-b1..led-b5 led-bh1 led-rgb1 led-v1 led-v2     CIE 15:2018
///   hps-100 lps mercury-100 metal-halide-3000         lamps measured by NIST
///   metal-halide-4000 t8-830 t8-841 incandescent-60   the same
///   blackbody-T                                       Planck, T = 1000..100000 K
///   daylight-T                                        CIE daylight series, T = 4000..25000 K
///   led-T                                             a white LED, see led_white; T = 2733..6597 K
/// Tables hold 380..780 nm every 5 nm; sources in spectrum/tables/README.md.
/// @throws InputError  unknown name (with the nearest), or a temperature out of range; the problem has no
/// place
SpectralCurve find_spectrum(std::string_view name);

/// All names, with an example of each that has a temperature.
std::vector<std::string> spectrum_names();

/// A white LED (blue chip and phosphor) of a correlated colour temperature: the mixture of the two of CIE
/// LED-B1..B5 next to it whose temperature is exactly `cct_K`. Not a standard spectrum; its Duv is between
/// those of the two, within 0.002 of the Planckian locus.
/// @param cct_K  within led_white_range
SpectralCurve led_white(double cct_K);

struct TemperatureRange {
  double low_K, high_K;
};
/// From the temperature of LED-B1 to that of LED-B5.
TemperatureRange led_white_range();

}  // namespace dim
