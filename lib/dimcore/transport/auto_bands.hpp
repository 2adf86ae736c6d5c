#pragma once

#include <vector>

#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "spectrum/band_choice.hpp"

namespace dim {

/// Spectra and how much light has each.
struct LampSpectra {
  std::vector<SpectralCurve> spectra;
  std::vector<double> flux_lm;
};
/// Those of the luminaires, one for each fitting that is used, of the sky and of the sun.
LampSpectra lamp_spectra(const Lights& lights);

/// The fewest bands for the lamps and the finishes of the zone's surfaces (choose_bands).
/// A finish that shines counts as what it reflects at normal incidence, whole and by its facets alone; a
/// glazing as what it lets through and what it reflects.
BandChoice auto_bands(const Zone& zone, const LampSpectra& lamps, const BandAccuracy& accuracy = {});

/// How far off bands chosen by hand are for them (judge_bands). A single band reflects with luminous
/// reflectances.
BandChoice judged_bands(const Zone& zone, const LampSpectra& lamps, const Bands& bands);

}  // namespace dim
