#include "transport/solution.hpp"

#include <cmath>

namespace dim {

std::vector<Vec3> Source::xyz_by_class(const ReflectanceClasses& classes) const {
  std::vector<Vec3> xyz(classes.size(), Vec3(0.0));
  for (std::size_t b = 0; b < classes.of_band.size(); ++b)
    xyz[classes.of_band[b]] +=
        kMaxEfficacy_lm_W * watts_per_lumen(b) * Vec3(weights.x[b], weights.y[b], weights.z[b]);
  return xyz;
}

WorstBalance worst_balance(const std::vector<Source>& sources) {
  WorstBalance worst;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t b = 0; b < sources[s].energy.size(); ++b) {
      const auto& energy = sources[s].energy[b];
      if (energy.emitted_W > 0.0 && std::abs(energy.imbalance) > std::abs(worst.imbalance))
        worst = {s, b, energy.imbalance};
    }
  }
  return worst;
}

}  // namespace dim
