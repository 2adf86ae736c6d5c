#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "network/stream_key.hpp"
#include "transport/direct.hpp"

namespace dim {
namespace {

FirstFlight fly(const Zone& zone, const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting,
                int n_rays, std::uint64_t stream) {
  const LowDiscrepancy4 points(stream);
  FirstFlight fate;
  double total = 0.0;
  for (int i = 0; i < n_rays; ++i) {
    const auto x = points(static_cast<std::uint64_t>(i));
    const auto [local, weight] = fitting.intensity.emission(x[0], x[1]);
    if (!(weight > 0.0)) continue;
    const Vec3 q = sample(luminaire.opening, {x[2], x[3]});
    const Vec3 from = luminaire.at + luminaire.to_world(q);
    const Hit hit = caster.nearest(from, luminaire.to_world(local));
    total += weight;
    const auto plate = static_cast<std::size_t>(hit.plate);
    if (hit.plate < 0 || (plate < zone.surfaces.size() && zone.surfaces[plate].outside))
      fate.escaped += weight;
    else if (hit.back || plate >= zone.surfaces.size())
      fate.lost += weight;
    else
      fate.received += weight;
  }
  fate.flux_lm = luminaire.factor * fitting.intensity.flux_lm() * total / n_rays;
  if (total > 0.0) {
    fate.escaped /= total;
    fate.lost /= total;
    fate.received /= total;
  }
  return fate;
}

}  // namespace

double typical_illuminance_lx(const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting) {
  constexpr int kRays = 256;
  const LowDiscrepancy4 points(0);
  double total = 0.0, sum = 0.0;
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const auto x = points(i);
    const auto [local, weight] = fitting.intensity.emission(x[0], x[1]);
    const double cd = fitting.intensity.at(local);
    if (!(weight > 0.0) || !(cd > 0.0)) continue;
    const Vec3 from = luminaire.at + luminaire.to_world(sample(luminaire.opening, {x[2], x[3]}));
    const Hit hit = caster.nearest(from, luminaire.to_world(local));
    if (hit.plate < 0) continue;
    total += weight;
    sum += weight * std::log(cd / (hit.t * hit.t));
  }
  return total > 0.0 ? std::exp(sum / total) : 0.0;
}

std::vector<FirstFlight> first_flights(const Zone& zone, const Lights& lights, int n_rays, const Job& job) {
  const Obstructions obstructions(zone, lights);
  std::vector<FirstFlight> fates(lights.luminaires.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, fates.size(), 1), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      const auto& luminaire = lights.luminaires[s];
      fates[s] = fly(zone, obstructions.caster(), luminaire,
                     lights.fittings[static_cast<std::size_t>(luminaire.fitting)], n_rays,
                     place_key(luminaire.at, luminaire.aim, zone.diameter_m));
    }
  });
  job.check();
  return fates;
}

}  // namespace dim
