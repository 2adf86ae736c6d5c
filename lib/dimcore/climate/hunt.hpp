#pragma once

#include <cstdint>

namespace dim {

/// Probability that someone who enters a room switches the lights on (Hunt 1980; equation 25 of the paper):
/// p = -0.0175 + 1.0361 / (1 + exp(4.0835 (log10 E - 1.8223))), kept within 0..1.
/// @param least_illuminance_lx  of the working area by daylight; at or below 0 the answer is 1
double switch_on_probability(double least_illuminance_lx);

/// Whether the lights go on at an arrival: the same for the same seed, circuit and step wherever it is asked.
bool switches_on(double least_illuminance_lx, std::uint64_t seed, std::uint64_t circuit, std::uint64_t step);

}  // namespace dim
