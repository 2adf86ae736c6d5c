#pragma once

#include <array>

#include "spectrum/tables/five_nanometres.hpp"

namespace dim {

/// TCS01-TCS08, which make Ra, and the strong red TCS09.
inline constexpr std::size_t kColourSamples = 9;

/// Reflectances of the test colour samples of CIE 13.3-1995.
const std::array<FiveNanometreTable, kColourSamples>& cie_colour_samples();

}  // namespace dim
