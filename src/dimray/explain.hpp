#pragma once

#include "common/program.hpp"
#include "spectrum/band_choice.hpp"
#include "transport/solution.hpp"

namespace dim {

/// Says what the scene required of the model, one line a decision.
void explain(Program& program, const Solution& solution, const BandChoice& bands);

}  // namespace dim
