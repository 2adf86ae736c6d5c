#pragma once

#include <string>
#include <vector>

#include "image/drawing.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// A curve of a spectrum diagram, with its name.
struct NamedCurve {
  std::string name;
  SpectralCurve curve;
};

/// Diagram of quantities 0..1 over 380..780 nm with a field of the colour they look.
/// @param curves  at least one; drawn in turn in full and dashed lines
Drawing spectrum_diagram(const std::vector<NamedCurve>& curves, Rgb8 colour, const std::string& title,
                         int width_px = 800, int height_px = 480);

}  // namespace dim
