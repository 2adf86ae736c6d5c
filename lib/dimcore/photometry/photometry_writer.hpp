#pragma once

#include <string>

#include "base/error.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// An LM-63-2002 (IES) file of a luminaire, types A, B and C: candela multiplier and ballast factor 1,
/// metres, absolute photometry where the luminaire's is. Intensities have ten significant digits. Keywords
/// are those of the luminaire; MANUFAC, TEST, LUMCAT and LUMINAIRE are added empty where absent, as the
/// standard asks.
std::string ies_text(const Photometry& photometry);

/// An EULUMDAT file of a luminaire. Intensities in cd/klm have ten significant digits, those of absolute
/// photometry (number of lamps -1) per 1000 lm of the luminaire.
///
/// Warned of, because the format has no place for it: types A and B, which are resampled to C-gamma every
/// 2.5 degrees; lamp tilt factors; openings other than points, rectangles, boxes, discs and upright
/// cylinders, which become the rectangle round them.
/// @throws InputError  a luminaire without light, which EULUMDAT cannot state relative to its flux
std::string eulumdat_text(const Photometry& photometry, Warnings& warnings);

}  // namespace dim
