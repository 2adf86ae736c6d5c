#pragma once

#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "spectrum/band_choice.hpp"

namespace dim {

/// The fewest bands for the spectra of the luminaires and the finishes of the zone's surfaces (choose_bands).
/// A finish that shines counts as what it reflects at normal incidence, whole and by its facets alone; a
/// glazing as what it lets through and what it reflects.
BandChoice auto_bands(const Zone& zone, const Lights& lights, const BandAccuracy& accuracy = {});

}  // namespace dim
