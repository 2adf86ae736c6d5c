#pragma once

#include <vector>

#include "light/first_flight.hpp"
#include "transport/plan.hpp"

namespace dim {

/// The first flights of each source, its luminaires weighted by flux: for the energy balance. They are counted
/// only where light can leave the zone, else 0. Luminaires whose light never reaches anything are warned of.
/// [n_sources]
/// @throws Interrupted
std::vector<FirstFlight> source_flights(const Room& room, const ModelPlan& plan, const Job& job,
                                        Warnings& warnings);

}  // namespace dim
