#pragma once

#include <optional>

#include "base/job.hpp"
#include "network/network.hpp"
#include "scene/lights.hpp"
#include "transport/solution.hpp"
#include "transport/track.hpp"

namespace dim {

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

/// Sends the light of all luminaires through the network.
///
/// Direct light is computed once for all bands; bands in which every finish reflects alike share one
/// solution.
/// @throws InputError  finishes this version does not model (glazing), diffuse reflectance >= 1, light beyond
///                     what single precision holds
/// @throws LimitError  when the solution does not fit job.memory_limit_bytes
Solution simulate(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                  const SimulationOptions& options, const Job& job, Warnings& warnings);

}  // namespace dim
