#pragma once

#include "spectrum/curve.hpp"
#include "spectrum/tables/five_nanometres.hpp"

namespace dim {

/// Colour-matching functions; y of the 1931 observer is the photopic luminous efficiency V.
struct Observer {
  SpectralCurve x, y, z;
};

/// CIE 1931 standard colorimetric observer (2 degrees), 380..780 nm in steps of 5 nm.
/// Source: ISO/CIE 11664-1 (CIE 018), CIE data under CC BY-SA 4.0.
const Observer& cie_1931_observer();

/// CIE 1964 standard colorimetric observer (10 degrees), as above.
const Observer& cie_1964_observer();

/// Photopic luminous efficiency V, CIE 1924: y of the 1931 observer.
const SpectralCurve& photopic_efficiency();

/// Scotopic luminous efficiency V', CIE 1951.
const SpectralCurve& scotopic_efficiency();

/// Melanopic action spectrum, CIE S 026:2018, peak 1 at 490 nm.
const SpectralCurve& melanopic_action();

/// The table's points as a curve.
SpectralCurve curve_of(FiveNanometreTable values);

}  // namespace dim
