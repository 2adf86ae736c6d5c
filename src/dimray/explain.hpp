#pragma once

#include "common/program.hpp"
#include "spectrum/band_choice.hpp"
#include "transport/plan.hpp"

namespace dim {

/// Says what the scene required of the model, one line a decision.
void explain(Program& program, const ModelPlan& plan, const BandChoice& bands);

}  // namespace dim
