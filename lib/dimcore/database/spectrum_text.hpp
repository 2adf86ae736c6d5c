#pragma once

#include <string>

#include "spectrum/curve.hpp"

namespace dim {

/// A light's spectrum written out on a command line as in the lights file, `[[nm, value], ...]`.
/// @throws InputError  syntax, faults of find_fault, no power at any visible wavelength; without a place
SpectralCurve read_spectrum_text(const std::string& text);

}  // namespace dim
