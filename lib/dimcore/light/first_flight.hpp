#pragma once

#include <vector>

#include "base/job.hpp"
#include "geometry/ray_caster.hpp"
#include "light/light_source.hpp"

namespace dim {

/// What becomes of a luminaire's light on its first flight, as shares of its flux.
struct FirstFlight {
  double received = 0.0;  ///< on the lit sides of the zone's surfaces
  double escaped = 0.0;   ///< out of the zone, external obstructions included
  double lost = 0.0;      ///< on backs of surfaces and on luminaire bodies
  double flux_lm = 0.0;   ///< of the sampled distribution, times the luminaire's factor
};

/// What illuminance the luminaire brings, its factor left out, where its light falls: the geometric mean over
/// its flux of I/r^2. 0 where none falls on anything.
double typical_illuminance_lx(const RayCaster& caster, const LightSource& source);

/// Sends `n_rays` low-discrepancy rays from every luminaire. Shares no code with `direct_light` but the ray
/// caster, so that the two check each other.
/// @param caster  the zone's surfaces, then whatever else stands there
/// @throws Interrupted
std::vector<FirstFlight> first_flights(const Zone& zone, const Lights& lights, const RayCaster& caster,
                                       int n_rays, const Job& job);

}  // namespace dim
