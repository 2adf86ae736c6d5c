#pragma once

#include <vector>

#include "base/error.hpp"

namespace dim {

/// Carries a type C table on to the ends of its hemispheres where it stops short of them with light left:
/// LM-63 begins at 0 or 90 degrees and ends at 90 or 180, but tables of half steps (2.5, 7.5 ... 87.5) exist,
/// and no light outside them would be a hole under the luminaire. The nearest value is taken, and warned of.
///
/// @param gamma_deg     strictly ascending within 0..180, at least two; the new ends are added
/// @param intensity_cd  [n_planes * n_gamma], gamma fastest; grows alike
/// @param place         of the angles, for the warning
void carry_on_to_hemispheres(std::vector<double>& gamma_deg, std::vector<double>& intensity_cd,
                             const Place& place, Warnings& warnings);

}  // namespace dim
