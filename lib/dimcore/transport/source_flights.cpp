#include "transport/source_flights.hpp"

#include <fmt/format.h>

namespace dim {
namespace {

constexpr int kProbeRays = 1024;     // to notice a luminaire in the wrong place
constexpr int kBalanceRays = 32768;  // to say what share of its light leaves the zone

}  // namespace

std::vector<FirstFlight> source_flights(const Room& room, const ModelPlan& plan, const Job& job,
                                        Warnings& warnings) {
  const RayCaster& caster = room.obstructions.caster();
  const auto probes = first_flights(room.zone, room.lights, caster, kProbeRays, job);
  // A few rays in a million that slip past an edge do not make a zone open.
  constexpr double kLeak = 1e-4;
  const double n_rays = static_cast<double>(room.network.sinks.n_rays());
  bool leaves = static_cast<double>(room.network.n_escaped_rays + room.network.n_back_rays) > kLeak * n_rays;
  for (std::size_t l = 0; l < probes.size(); ++l) {
    const auto& luminaire = room.lights.luminaires[l];
    const double off = probes[l].escaped + probes[l].lost;
    leaves = leaves || off > kLeak * 10.0;
    if (off > 0.5)
      warnings.push_back(
          {luminaire.place,
           fmt::format("luminaire '{}': {:.0f} % of its light never reaches the lit side of a surface; it "
                       "seems to be outside the zone or inside an obstruction",
                       luminaire.name, 100.0 * off),
           "check 'at' and 'aim'"});
  }
  std::vector<FirstFlight> flights(plan.n_sources());
  if (!leaves) return flights;
  const auto counted = first_flights(room.zone, room.lights, caster, kBalanceRays, job);
  for (std::size_t l = 0; l < counted.size(); ++l) {
    const std::size_t s = plan.source_of[l];
    const double weight =
        plan.sources[s].flux_lm > 0.0 ? counted[l].flux_lm / plan.sources[s].flux_lm : 0.0;
    flights[s].escaped += weight * counted[l].escaped;
    flights[s].lost += weight * counted[l].lost;
  }
  return flights;
}

}  // namespace dim
