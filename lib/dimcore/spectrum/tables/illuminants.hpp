#pragma once

#include "spectrum/tables/five_nanometres.hpp"

namespace dim {

/// CIE 15: A, C, D50, D55, D65, D75.
std::span<const TabulatedSpectrum> standard_illuminants();
/// CIE 15: FL1-FL12, FL3.1-FL3.15.
std::span<const TabulatedSpectrum> fluorescent_lamps();
/// CIE 15: HP1-HP5; and lamps measured by NIST.
std::span<const TabulatedSpectrum> discharge_lamps();
/// CIE 15:2018: LED-B1..B5, BH1, RGB1, V1, V2.
std::span<const TabulatedSpectrum> led_lamps();

/// Components of the CIE daylight series (CIE 15).
struct DaylightBasis {
  FiveNanometreTable s0, s1, s2;
};
DaylightBasis daylight_basis();

}  // namespace dim
