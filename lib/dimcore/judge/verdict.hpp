#pragma once

#include <string>
#include <vector>

namespace dim {

/// Whether a limit is kept. Undecided: it lies within the value's stated error, or there is no value.
enum class Verdict { met, not_met, undecided };

/// "met", "not met", "undecided"
const char* verdict_name(Verdict verdict);

/// @param error  >= 0, the value may be off by as much either way; a NaN value leaves the matter undecided
Verdict judge_at_least(double value, double error, double limit);
Verdict judge_at_most(double value, double error, double limit);

/// The worst of them: one that is not met outweighs one undecided; met where there are none.
Verdict overall(const std::vector<Verdict>& verdicts);

}  // namespace dim
