#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/low_discrepancy.hpp"
#include "transport/direct.hpp"

namespace dim {
namespace {

// Uniform on the sphere in the luminaire's frame.
Vec3 on_sphere(double a, double b) {
  const double z = 1.0 - 2.0 * a, r = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {r * std::cos(2.0 * kPi * b), r * std::sin(2.0 * kPi * b), z};
}

FirstFlight fly(const Zone& zone, const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting,
                int n_rays, std::uint64_t stream) {
  const LowDiscrepancy4 points(stream);
  FirstFlight fate;
  double total_cd = 0.0;
  for (int i = 0; i < n_rays; ++i) {
    const auto x = points(static_cast<std::uint64_t>(i));
    const Vec3 local = on_sphere(x[0], x[1]);
    const double cd = fitting.intensity.at(local);
    if (!(cd > 0.0)) continue;
    const Vec3 q = sample(luminaire.opening, {x[2], x[3]});
    const Vec3 from = luminaire.at + luminaire.to_world(q);
    const Hit hit = caster.nearest(from, luminaire.to_world(local));
    total_cd += cd;
    const auto plate = static_cast<std::size_t>(hit.plate);
    if (hit.plate < 0 || (plate < zone.surfaces.size() && zone.surfaces[plate].outside))
      fate.escaped += cd;
    else if (hit.back || plate >= zone.surfaces.size())
      fate.lost += cd;
    else
      fate.received += cd;
  }
  fate.flux_lm = luminaire.factor * 4.0 * kPi * total_cd / n_rays;
  if (total_cd > 0.0) {
    fate.escaped /= total_cd;
    fate.lost /= total_cd;
    fate.received /= total_cd;
  }
  return fate;
}

}  // namespace

double typical_illuminance_lx(const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting) {
  constexpr int kRays = 256;
  const LowDiscrepancy4 points(0);
  double total_cd = 0.0, sum = 0.0;
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const auto x = points(i);
    const Vec3 local = on_sphere(x[0], x[1]);
    const double cd = fitting.intensity.at(local);
    if (!(cd > 0.0)) continue;
    const Vec3 from = luminaire.at + luminaire.to_world(sample(luminaire.opening, {x[2], x[3]}));
    const Hit hit = caster.nearest(from, luminaire.to_world(local));
    if (hit.plate < 0) continue;
    total_cd += cd;
    sum += cd * std::log(cd / (hit.t * hit.t));
  }
  return total_cd > 0.0 ? std::exp(sum / total_cd) : 0.0;
}

std::vector<FirstFlight> first_flights(const Zone& zone, const Lights& lights, int n_rays, const Job& job) {
  const Obstructions obstructions(zone, lights);
  std::vector<FirstFlight> fates(lights.luminaires.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, fates.size(), 1), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      const auto& luminaire = lights.luminaires[s];
      fates[s] = fly(zone, obstructions.caster(), luminaire,
                     lights.fittings[static_cast<std::size_t>(luminaire.fitting)], n_rays, s);
    }
  });
  job.check();
  return fates;
}

}  // namespace dim
