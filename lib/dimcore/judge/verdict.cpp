#include "judge/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace dim {

const char* verdict_name(Verdict verdict) {
  return verdict == Verdict::met ? "met" : verdict == Verdict::not_met ? "not met" : "undecided";
}

Verdict judge_at_least(double value, double error, double limit) {
  if (std::isnan(value)) return Verdict::undecided;
  if (value - error >= limit) return Verdict::met;
  return value + error < limit ? Verdict::not_met : Verdict::undecided;
}

Verdict judge_at_most(double value, double error, double limit) {
  return judge_at_least(-value, error, -limit);
}

Verdict overall(const std::vector<Verdict>& verdicts) {
  for (const Verdict worst : {Verdict::not_met, Verdict::undecided})
    if (std::find(verdicts.begin(), verdicts.end(), worst) != verdicts.end()) return worst;
  return Verdict::met;
}

}  // namespace dim
