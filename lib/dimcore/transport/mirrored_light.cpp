#include "transport/mirrored_light.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr std::size_t kRun = 64;    // lights that are summed as one,
constexpr std::size_t kBatch = 64;  // and runs that are kept before they are added up
// Paths along which light comes in on a mirror cell: to know what it reflects, and for rays to go on from.
constexpr int kPaths = 16;
constexpr double kLeastRays = 4, kMostRays = 1024;

}  // namespace

MirroredLight::MirroredLight(const Zone& zone, const Cells& cells, const ReflectanceClasses& classes,
                             const Shine& shine, const RayCaster& caster,
                             const std::vector<std::size_t>& source_of, std::size_t n_sources, bool can_leave)
    : zone_(zone),
      cells_(cells),
      classes_(classes),
      shine_(shine),
      caster_(caster),
      source_of_(source_of),
      n_sources_(n_sources),
      can_leave_(can_leave),
      reflected_(n_sources * classes.size(), 0.0),
      escaped_(reflected_),
      not_followed_(reflected_),
      sent_lm_(n_sources, 0.0),
      rays_(shine.n_off_specular()) {}

double MirroredLight::reflected_lm(const CellLight& light) const {
  const Surface& surface = zone_.surfaces[cells_.surface_of(light.cell)];
  const Vec3 at = middle_of(zone_, cells_, light.cell);
  auto left = tints_of(zone_, classes_, *light.emitter, at);
  Vec3 direction = glm::normalize(at - light.emitter->luminaire.at);
  return cells_.area_m2(light.cell) * light.lx *
         meet_mirror(surface.polygon.frame().n, direction, left,
                     [&](std::size_t q) -> const BandReflection& { return classes_.at(q, surface.finish); });
}

template <class Handle>
void MirroredLight::for_runs(const std::vector<CellLight>& lights, const Job& job, Handle&& handle) {
  for (std::size_t first = 0; first < lights.size(); first += kRun * kBatch) {
    const std::size_t n_runs = std::min(kBatch, (lights.size() - first + kRun - 1) / kRun);
    std::vector<Run> runs(n_runs);
    tbb::parallel_for(std::size_t{0}, n_runs, [&](std::size_t r) {
      runs[r].of_source.assign(n_sources_, MirrorFate(classes_.size()));
      runs[r].sent_lm.assign(n_sources_, 0.0);
      const std::size_t begin = first + r * kRun, end = std::min(lights.size(), begin + kRun);
      for (std::size_t i = begin; i < end && !job.stopped(); ++i) handle(lights[i], runs[r]);
    });
    job.check();
    for (const auto& run : runs) add(run);
  }
}

void MirroredLight::pass_on(const std::vector<CellLight>& lights, const Job& job) {
  for_runs(lights, job, [&](const CellLight& light, Run& run) { pass_on(light, run); });
}

void MirroredLight::follow(const std::vector<CellLight>& lights, const std::vector<double>& ray_lm,
                           const Job& job) {
  for_runs(lights, job,
           [&](const CellLight& light, Run& run) { follow(light, ray_lm[light.emitter->original], run); });
}

void MirroredLight::pass_on(const CellLight& light, Run& run) const {
  const auto mirror = cells_.surface_of(light.cell);
  const Surface& surface = zone_.surfaces[mirror];
  const auto tints = tints_of(zone_, classes_, *light.emitter, middle_of(zone_, cells_, light.cell));
  MirrorFate& fate = run.of_source[source_of_[light.emitter->original]];
  std::vector<double> flux(tints.size());
  for (const auto& path : paths_of(zone_, cells_, light, kPaths)) {
    if (!(path.lx > 0.0)) continue;
    for (std::size_t q = 0; q < tints.size(); ++q)
      flux[q] = cells_.area_m2(light.cell) * light.lx * path.lx * tints[q];
    Vec3 direction = -path.towards;
    meet_mirror(surface.polygon.frame().n, direction, flux,
                [&](std::size_t q) -> const BandReflection& { return classes_.at(q, surface.finish); });
    const bool gone = can_leave_ && leaves({path.at, direction, 0.0}, static_cast<int>(mirror));
    for (std::size_t q = 0; q < tints.size(); ++q) {
      fate.reflected[q] += flux[q];
      if (gone) fate.escaped[q] += flux[q];
    }
  }
}

// Whether light that goes on along `path.towards` meets nothing, or a back.
bool MirroredLight::leaves(const PairIntegrator::Path& path, int mirror) const {
  const Hit hit = caster_.nearest(path.at, path.towards, mirror);
  const auto plate = static_cast<std::size_t>(hit.plate);
  return hit.plate < 0 || hit.back || plate >= zone_.surfaces.size() || zone_.surfaces[plate].outside;
}

void MirroredLight::follow(const CellLight& light, double ray_lm, Run& run) const {
  const std::size_t mirror = cells_.surface_of(light.cell);
  const std::size_t source = source_of_[light.emitter->original];
  const auto tints = tints_of(zone_, classes_, *light.emitter, middle_of(zone_, cells_, light.cell));
  const double sent_lm = reflected_lm(light);
  const auto n = static_cast<int>(std::clamp(std::ceil(sent_lm / ray_lm), kLeastRays, kMostRays));
  run.sent_lm[source] += sent_lm;
  MirrorFate& fate = run.of_source[source];
  std::vector<double> left(tints.size());
  for (const auto& path : paths_of(zone_, cells_, light, n)) {
    if (!(path.lx > 0.0)) continue;
    ++run.n_rays;
    const double lm = cells_.area_m2(light.cell) * light.lx * path.lx;
    const auto add_to = [&](std::vector<double>& sum) {
      for (std::size_t q = 0; q < tints.size(); ++q) sum[q] += lm * tints[q] * left[q];
    };
    std::fill(left.begin(), left.end(), 1.0);
    const Ray ray{path.at + path.towards, -path.towards};
    const auto end =
        shine_.mirror_rays().follow(ray, mirror, left, [&](std::size_t cell, const Vec3& direction) {
          add_to(fate.reflected);
          run.landings.push_back({cell, source, direction});
          for (std::size_t q = 0; q < tints.size(); ++q) run.flux.push_back(lm * tints[q] * left[q]);
        });
    if (end == MirrorRays::End::cut) add_to(fate.not_followed);
    if (end != MirrorRays::End::escaped) continue;
    add_to(fate.reflected);
    add_to(fate.escaped);
  }
}

void MirroredLight::add(const Run& run) {
  const std::size_t n_classes = classes_.size(), n_columns = n_sources_ * n_classes;
  n_rays_ += run.n_rays;
  for (std::size_t s = 0; s < n_sources_; ++s) {
    sent_lm_[s] += run.sent_lm[s];
    for (std::size_t q = 0; q < n_classes; ++q) {
      reflected_[q * n_sources_ + s] += run.of_source[s].reflected[q];
      escaped_[q * n_sources_ + s] += run.of_source[s].escaped[q];
      not_followed_[q * n_sources_ + s] += run.of_source[s].not_followed[q];
    }
  }
  if (run.landings.empty()) return;
  if (brought_.empty()) brought_.assign(cells_.size() * n_columns, 0.0);
  for (std::size_t l = 0; l < run.landings.size(); ++l) {
    const auto& landing = run.landings[l];
    const double per_m2 = 1.0 / cells_.area_m2(landing.cell);
    for (std::size_t q = 0; q < n_classes; ++q)
      brought_[landing.cell * n_columns + q * n_sources_ + landing.source] +=
          per_m2 * run.flux[l * n_classes + q];
    const auto g = shine_.index_of(landing.cell);
    if (g < 0) continue;
    RayLight ray{landing.direction, landing.source, {}};
    for (std::size_t q = 0; q < n_classes; ++q) ray.lx.push_back(per_m2 * run.flux[l * n_classes + q]);
    rays_[static_cast<std::size_t>(g)].push_back(std::move(ray));
  }
}

}  // namespace dim
