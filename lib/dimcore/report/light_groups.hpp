#pragma once

#include <string>
#include <vector>

#include "result/luminous.hpp"

namespace dim {

/// Light that a report's reader can dim: sources that go up and down together.
struct LightGroup {
  std::string name;
  Mix full;               ///< its sources' factors with its slider at 1, others 0
  double start = 1.0;     ///< where the slider stands at first: the mix asked for
  double kept = 1.0;      ///< maintained over new light; 0 for daylight, which no requirement counts
  bool daylight = false;
};

/// More sliders than this nobody moves.
inline constexpr std::size_t kMostGroups = 12;

/// The groups of a mix: luminaires by their group (or each by itself where it has none), sources of one group apart
/// where their factors or maintenance differ, all daylight together as the sky asked for has it. Where these are more than
/// kMostGroups, luminaires of one maintenance factor make one group. Light that adds up to the mix with all at `start`.
/// @param kept  [n_sources] maintained over new light
std::vector<LightGroup> light_groups(const LuminanceDatabase& database, const Mix& mix, const std::vector<double>& kept);

}  // namespace dim
