#pragma once

#include "spectrum/curve.hpp"

namespace dim {

/// Colour-matching functions; y is the photopic luminous efficiency V.
struct Observer {
  SpectralCurve x, y, z;
};

/// CIE 1931 standard colorimetric observer (2 degrees), 380..780 nm in steps of 5 nm.
/// Source: ISO/CIE 11664-1 (CIE 018), CIE data under CC BY-SA 4.0.
const Observer& cie_1931_observer();

}  // namespace dim
