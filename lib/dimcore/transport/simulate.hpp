#pragma once

#include "base/job.hpp"
#include "network/network.hpp"
#include "scene/lights.hpp"
#include "transport/simulation_options.hpp"
#include "transport/solution.hpp"

namespace dim {

/// Sends the light of all luminaires through the network.
///
/// What the scene requires is decided first (`ModelPlan`). Direct light is computed once for all bands, then
/// reflected on through the network, or tracked; bands in which every finish reflects alike share one solution.
/// @throws InputError  finishes this version does not model (glazing), diffuse reflectance >= 1, light beyond
///                     what single precision holds
/// @throws LimitError  when the solution does not fit job.memory_limit_bytes
/// @throws Interrupted
Solution simulate(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
                  const SimulationOptions& options, const Job& job, Warnings& warnings);

}  // namespace dim
