#pragma once

#include "common/program.hpp"
#include "transport/solution.hpp"

namespace dim {

/// How inter-reflection was asked to end.
struct EndOfBounces {
  bool tracked = false;      ///< --solver track, whose threshold decides instead of the tolerance
  double tolerance = 0.0;
};

/// Says where the light of a solution went, puts the same into --stats and judges it.
/// @returns check_failed, with words, where the tolerance was not reached or the energy balance of a source in
///          a band is open by more than 0.2 %
Exit report(Program& program, const Solution& solution, const EndOfBounces& end);

}  // namespace dim
