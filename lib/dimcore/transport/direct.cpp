#include "transport/direct.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace dim {
namespace {

// Rays that probe the visibility of a pair, and how many more where they disagree. Parts of a halved pair
// share them. They are spread over cell and opening by chance, the same chance in every run: a fixed pattern
// would miss the same strip of every cell along the foot of a cabinet. The fewer luminaires, the more each
// gets: of many, the errors average out.
constexpr int kProbeRaysPerReceiver = 384;
constexpr int kMostProbeRays = 64;
constexpr int kLeastProbeRays = 16;
// Pairs that bring less than this share of the mean direct illuminance get a few rays only. Their mean is as
// unbiased as the rest's, only coarser, and there are many of them.
constexpr double kFaint = 1e-2;

double total_area_m2(const Zone& zone) {
  return std::accumulate(zone.surfaces.begin(), zone.surfaces.end(), 0.0,
                         [](double sum, const Surface& s) { return sum + s.polygon.area_m2(); });
}

double total_flux_lm(const Lights& lights) {
  return std::accumulate(
      lights.luminaires.begin(), lights.luminaires.end(), 0.0, [&](double sum, const Luminaire& l) {
        return sum + l.factor * lights.fittings[static_cast<std::size_t>(l.fitting)].intensity.flux_lm();
      });
}

}  // namespace

Receiver cell_receiver(const Zone& zone, const Cells& cells, std::size_t cell) {
  const auto surface = cells.surface_of(cell);
  const auto& polygon = zone.surfaces[surface].polygon;
  return {&polygon.frame(),
          &polygon,
          cells[cell].whole,
          static_cast<int>(surface),
          mix(cell),
          &cells[cell].centroid,
          &cells.grid(surface),
          static_cast<int>(cell - cells.first(surface))};
}

std::vector<PairIntegrator> make_integrators(const Zone& zone, const Lights& lights,
                                             const std::vector<Emitter>& emitters, const RayCaster& caster,
                                             bool in_the_way) {
  const double faint_lx = kFaint * total_flux_lm(lights) / total_area_m2(zone);
  const int n_probe_rays = std::clamp(kProbeRaysPerReceiver / std::max(1, static_cast<int>(emitters.size())),
                                      kLeastProbeRays, kMostProbeRays);
  std::vector<PairIntegrator> integrators;
  for (const auto& emitter : emitters)
    integrators.emplace_back(zone, caster, emitter, faint_lx, n_probe_rays, integrators.size(), in_the_way);
  return integrators;
}

void direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                  const std::vector<Emitter>& emitters, const RayCaster& caster, const DirectSink& on_cell,
                  const DirectSink& on_point, const Job& job, bool in_the_way) {
  const auto integrators = make_integrators(zone, lights, emitters, caster, in_the_way);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 8), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Part pair = whole_pair(cells[i].low, cells[i].high);
      const Receiver receiver = cell_receiver(zone, cells, i);
      for (std::size_t e = 0; e < emitters.size(); ++e)
        on_cell(i, e, emitters[e].luminaire.factor * integrators[e].mean(receiver, pair));
    }
  });
  job.check();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, zone.points.size(), 8), [&](const auto& range) {
    if (job.stopped()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Frame frame = frame_at(zone.points[i]);
      const Receiver receiver{&frame, nullptr, true, -1, mix(~i), nullptr};
      for (std::size_t e = 0; e < emitters.size(); ++e)
        on_point(
            i, e,
            emitters[e].luminaire.factor * integrators[e].mean(receiver, whole_pair(Vec2(0.0), Vec2(0.0))));
    }
  });
  job.check();
}

DirectLight direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                         const std::vector<std::size_t>& source_of, std::size_t n_sources, const Job& job) {
  const Obstructions obstructions(zone, lights);
  DirectLight result;
  result.cell_lx.assign(cells.size() * n_sources, 0.0);
  result.point_lx.assign(zone.points.size() * n_sources, 0.0);
  const auto add_to = [&](std::vector<double>& sums) {
    return [&](std::size_t i, std::size_t e, double lx) { sums[i * n_sources + source_of[e]] += lx; };
  };
  direct_light(zone, cells, lights, make_emitters(zone, lights, {}, 0), obstructions.caster(),
               add_to(result.cell_lx), add_to(result.point_lx), job);
  return result;
}

}  // namespace dim
