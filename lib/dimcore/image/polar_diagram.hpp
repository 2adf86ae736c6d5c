#pragma once

#include <string>

#include "image/drawing.hpp"
#include "photometry/intensity.hpp"

namespace dim {

/// Polar diagram of a luminaire's intensity: gamma 0 downwards, rings of round numbers of candela. The planes
/// C0 (right) and C180 (left) make one full line, C90 (right) and C270 (left) a dashed one; a luminaire
/// without difference between them has the first only.
/// @param size_px  width and height, at least 200
Drawing polar_diagram(const IntensityTable& intensity, const std::string& title, int size_px = 640);

}  // namespace dim
