#pragma once

#include "base/job.hpp"
#include "transport/plan.hpp"

namespace dim {

/// Asks for the memory that the plan will take, before any of it is taken.
/// @throws LimitError  naming the options that help
void check_memory(const Room& room, const ModelPlan& plan, const Job& job);

}  // namespace dim
