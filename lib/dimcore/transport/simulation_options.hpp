#pragma once

#include <optional>

#include "spectrum/bands.hpp"
#include "transport/gather.hpp"
#include "transport/track.hpp"

namespace dim {

/// Which luminaires are solved as one source: none, those of a group, or all.
enum class Combine { each, group, all };

enum class Solver { gather, track };

struct SimulationOptions {
  Bands bands;
  Combine combine = Combine::each;
  GatherOptions gather;
  Solver solver = Solver::gather;
  TrackOptions track;
  /// Savings not to be made (see `ModelPlan`): test visibility even where nothing can be in the way; solve
  /// each band even where bands reflect alike.
  bool always_test_visibility = false;
  bool solve_every_band = false;
  /// Mirrors one after the other that luminaires are imaged in; as many as the tolerance of the iteration
  /// asks for where it is not given.
  std::optional<int> mirror_depth;
};

}  // namespace dim
