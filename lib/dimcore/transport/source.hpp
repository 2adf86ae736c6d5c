#pragma once

#include <optional>
#include <string>
#include <vector>

#include "light/outside_light.hpp"
#include "scene/lights.hpp"
#include "spectrum/bands.hpp"
#include "transport/optics.hpp"
#include "transport/simulation_options.hpp"

namespace dim {

/// Where one source's flux in one band went, W. `imbalance` is what is left of emitted after absorbed,
/// escaped, lost and dropped, over emitted: what the sampling of direct light misses and what the network's
/// columns are off by.
struct EnergyBalance {
  double emitted_W = 0.0;
  double absorbed_W = 0.0;
  double escaped_W = 0.0;  ///< out of an open zone, or reflected onto backs of surfaces
  double lost_W = 0.0;     ///< direct, on backs of surfaces and on luminaire bodies
  double dropped_W = 0.0;  ///< still being reflected when the solution was good enough; either sign
  double imbalance = 0.0;
};

/// What a source of daylight is: a part of the outside through a group of windows (`Source::group`) in one state.
struct DaylightOrigin {
  DaylightPart part = DaylightPart::sky;
  int patch = -1;         ///< of coefficients, or the band of a ramp; -1: the whole sky, ground or sun
  std::string state;      ///< of the windows
  bool as_it_stands = true;  ///< the state they have in the zone file; others count where they are asked for
};

/// The column of SkyPatches that a source of coefficients is.
std::size_t column_of(const DaylightOrigin& origin, const SkyPatches& patches);

/// The outside that a solution was made for.
struct SkyRecord {
  int subdivision = 0;         ///< of coefficients: 1, 2 or 4, the columns of SkyPatches at 1 cd/m2; 0: one sky
  double horizontal_lx = 0.0;  ///< one sky: unobstructed, of the sky alone
  double ground_reflectance = 0.2;
};

/// What is solved as one: a luminaire, a group of them or all, with one spectrum; or a part of daylight.
struct Source {
  std::string name;
  std::string group;
  std::vector<std::string> luminaires;
  double flux_lm = 0.0;  ///< of windows: what comes in
  std::optional<double> maintenance;  ///< of the lights file: maintained over initial light, which flux_lm is
  std::optional<DaylightOrigin> daylight;
  BandWeights weights;
  std::vector<EnergyBalance> energy;  ///< [n_bands]
  int iterations = 0;
  double residual = 0.0;
  double error_bound = 0.0;  ///< truncation of inter-reflection, relative to the mean irradiance

  /// W in a band for each lm of the source: what turns transfer into irradiance.
  double watts_per_lumen(std::size_t band) const { return weights.share[band] / weights.efficacy_lm_W; }
  /// CIE 1931 XYZ, Y in lm, of 1 lm sent through each class, its bands together: [n_classes]. The Y add up
  /// to 1.
  std::vector<Vec3> xyz_by_class(const ReflectanceClasses& classes) const;
};

/// Luminaires made sources: of the same name after combining, the same spectrum and maintenance.
struct CombinedSources {
  std::vector<Source> sources;
  std::vector<std::size_t> of_luminaire;  ///< [n_luminaires]
};
CombinedSources combine(const Lights& lights, const Bands& bands, Combine how);

/// The source and band whose energy balance is open the most, among those with any light. All light through a group
/// of windows in one state counts as one source, the first: what single patches of the sky send is known by few rays.
struct WorstBalance {
  std::size_t source = 0, band = 0;
  double imbalance = 0.0;  ///< signed; 0 where no source has any light
};
WorstBalance worst_balance(const std::vector<Source>& sources);

}  // namespace dim
