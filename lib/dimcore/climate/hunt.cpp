#include "climate/hunt.hpp"

#include <algorithm>
#include <cmath>

#include "base/low_discrepancy.hpp"

namespace dim {

double switch_on_probability(double least_illuminance_lx) {
  if (least_illuminance_lx <= 0.0) return 1.0;
  const double p = -0.0175 + 1.0361 / (1.0 + std::exp(4.0835 * (std::log10(least_illuminance_lx) - 1.8223)));
  return std::clamp(p, 0.0, 1.0);
}

bool switches_on(double least_illuminance_lx, std::uint64_t seed, std::uint64_t circuit, std::uint64_t step) {
  return unit_from(mix(mix(mix(seed) ^ circuit) ^ step)) < switch_on_probability(least_illuminance_lx);
}

}  // namespace dim
