#pragma once

#include <vector>

#include "image/colour_map.hpp"

namespace dim {

/// Levels strictly between the least and the greatest value, ascending: those of the customary series
/// … 1 1.5 2 3 5 7.5 10 15 20 … (EN 12464-1's steps of illuminance), from a hundredth of the greatest value
/// up; round linear steps where fewer than four of the series lie between. None where the values are equal
/// but for rounding.
std::vector<double> customary_levels(double least, double greatest);

/// Colours of the bands below, between and above n levels, [n + 1]: colour_map, lightened so that black lines
/// and words on them can be read.
std::vector<Rgb8> band_colours(std::size_t n_levels);

}  // namespace dim
