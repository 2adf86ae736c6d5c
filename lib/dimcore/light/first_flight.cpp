#include "light/first_flight.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/low_discrepancy.hpp"

namespace dim {
namespace {

FirstFlight fly(const Zone& zone, const RayCaster& caster, const LightSource& source, int n_rays) {
  const LowDiscrepancy4 points(source.stream);
  FirstFlight fate;
  double total = 0.0;
  for (int i = 0; i < n_rays; ++i) {
    const auto [ray, weight] = source.emit(points(static_cast<std::uint64_t>(i)));
    if (!(weight > 0.0)) continue;
    const Hit hit = caster.nearest(ray.from, ray.direction);
    total += weight;
    const auto plate = static_cast<std::size_t>(hit.plate);
    if (hit.plate < 0 || (plate < zone.surfaces.size() && zone.surfaces[plate].outside))
      fate.escaped += weight;
    else if (hit.back || plate >= zone.surfaces.size())
      fate.lost += weight;
    else
      fate.received += weight;
  }
  fate.flux_lm = source.power_lm() * total / n_rays;
  if (total > 0.0) {
    fate.escaped /= total;
    fate.lost /= total;
    fate.received /= total;
  }
  return fate;
}

}  // namespace

double typical_illuminance_lx(const RayCaster& caster, const LightSource& source) {
  constexpr int kRays = 256;
  const LowDiscrepancy4 points(0);
  double total = 0.0, sum = 0.0;
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const auto [ray, weight] = source.emit(points(i));
    const double cd = source.fitting->intensity.at(source.luminaire.to_local(ray.direction));
    if (!(weight > 0.0) || !(cd > 0.0)) continue;
    const Hit hit = caster.nearest(ray.from, ray.direction);
    if (hit.plate < 0) continue;
    total += weight;
    sum += weight * std::log(cd / (hit.t * hit.t));
  }
  return total > 0.0 ? std::exp(sum / total) : 0.0;
}

std::vector<FirstFlight> first_flights(const Zone& zone, const Lights& lights, const RayCaster& caster,
                                       int n_rays, const Job& job) {
  const auto sources = own_sources(zone, lights);
  std::vector<FirstFlight> fates(sources.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, fates.size(), 1), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end() && !job.stopped(); ++s)
      fates[s] = fly(zone, caster, sources[s], n_rays);
  });
  job.check();
  return fates;
}

}  // namespace dim
