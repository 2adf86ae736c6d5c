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

MirroredLight::MirroredLight(const Room& room, const ModelPlan& plan, const Shine& shine)
    : room_(room),
      plan_(plan),
      shine_(shine),
      reflected_(plan.n_columns(), 0.0),
      escaped_(reflected_),
      not_followed_(reflected_),
      sent_lm_(plan.n_sources(), 0.0),
      rays_(shine.n_off_specular()) {}

double MirroredLight::reflected_lm(const CellLight& light) const {
  const Surface& surface = room_.surface_of(light.cell);
  const Vec3 at = middle_of(room_, light.cell);
  auto left = tints_of(room_.zone, plan_.classes, light.source(), at);
  Vec3 direction = glm::normalize(at - light.source().luminaire.at);
  return room_.cells.area_m2(light.cell) * light.lx *
         meet_mirror(surface.polygon.frame().n, direction, left,
                     [&](std::size_t q) -> const BandReflection& { return plan_.classes.at(q, surface.finish); });
}

template <class Handle>
void MirroredLight::for_runs(const std::vector<CellLight>& lights, const Job& job, Handle&& handle) {
  for (std::size_t first = 0; first < lights.size(); first += kRun * kBatch) {
    const std::size_t n_runs = std::min(kBatch, (lights.size() - first + kRun - 1) / kRun);
    std::vector<Run> runs(n_runs);
    tbb::parallel_for(std::size_t{0}, n_runs, [&](std::size_t r) {
      runs[r].of_source.assign(plan_.n_sources(), MirrorFate(plan_.classes.size()));
      runs[r].sent_lm.assign(plan_.n_sources(), 0.0);
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
           [&](const CellLight& light, Run& run) { follow(light, ray_lm[light.source().original], run); });
}

void MirroredLight::pass_on(const CellLight& light, Run& run) const {
  const auto mirror = room_.cells.surface_of(light.cell);
  const Surface& surface = room_.surface_of(light.cell);
  const auto tints = tints_of(room_.zone, plan_.classes, light.source(), middle_of(room_, light.cell));
  MirrorFate& fate = run.of_source[plan_.source_of[light.source().original]];
  std::vector<double> flux(tints.size());
  for (const auto& path : paths_of(room_, light, kPaths)) {
    if (!(path.lx > 0.0)) continue;
    for (std::size_t q = 0; q < tints.size(); ++q)
      flux[q] = room_.cells.area_m2(light.cell) * light.lx * path.lx * tints[q];
    Vec3 direction = -path.towards;
    meet_mirror(surface.polygon.frame().n, direction, flux,
                [&](std::size_t q) -> const BandReflection& { return plan_.classes.at(q, surface.finish); });
    // Where nothing can be in the way nothing can be let out either.
    const bool gone = plan_.tests_visibility && leaves({path.at, direction, 0.0}, static_cast<int>(mirror));
    for (std::size_t q = 0; q < tints.size(); ++q) {
      fate.reflected[q] += flux[q];
      if (gone) fate.escaped[q] += flux[q];
    }
  }
}

// Whether light that goes on along `path.towards` meets nothing, or a back.
bool MirroredLight::leaves(const PairIntegrator::Path& path, int mirror) const {
  const Hit hit = room_.obstructions.caster().nearest(path.at, path.towards, mirror);
  const auto plate = static_cast<std::size_t>(hit.plate);
  return hit.plate < 0 || hit.back || plate >= room_.zone.surfaces.size() || room_.zone.surfaces[plate].outside;
}

void MirroredLight::follow(const CellLight& light, double ray_lm, Run& run) const {
  const std::size_t mirror = room_.cells.surface_of(light.cell);
  const std::size_t source = plan_.source_of[light.source().original];
  const auto tints = tints_of(room_.zone, plan_.classes, light.source(), middle_of(room_, light.cell));
  const double sent_lm = reflected_lm(light);
  const auto n = static_cast<int>(std::clamp(std::ceil(sent_lm / ray_lm), kLeastRays, kMostRays));
  run.sent_lm[source] += sent_lm;
  MirrorFate& fate = run.of_source[source];
  std::vector<double> left(tints.size());
  for (const auto& path : paths_of(room_, light, n)) {
    if (!(path.lx > 0.0)) continue;
    ++run.n_rays;
    const double lm = room_.cells.area_m2(light.cell) * light.lx * path.lx;
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
  const std::size_t n_classes = plan_.n_classes(), n_columns = plan_.n_columns();
  n_rays_ += run.n_rays;
  for (std::size_t s = 0; s < plan_.n_sources(); ++s) {
    sent_lm_[s] += run.sent_lm[s];
    for (std::size_t q = 0; q < n_classes; ++q) {
      reflected_[plan_.column(s, q)] += run.of_source[s].reflected[q];
      escaped_[plan_.column(s, q)] += run.of_source[s].escaped[q];
      not_followed_[plan_.column(s, q)] += run.of_source[s].not_followed[q];
    }
  }
  if (run.landings.empty()) return;
  if (brought_.empty()) brought_.assign(room_.cells.size() * n_columns, 0.0);
  for (std::size_t l = 0; l < run.landings.size(); ++l) {
    const auto& landing = run.landings[l];
    const double per_m2 = 1.0 / room_.cells.area_m2(landing.cell);
    for (std::size_t q = 0; q < n_classes; ++q)
      brought_[landing.cell * n_columns + plan_.column(landing.source, q)] +=
          per_m2 * run.flux[l * n_classes + q];
    const auto g = shine_.index_of(landing.cell);
    if (g < 0) continue;
    RayLight ray{landing.direction, landing.source, {}};
    for (std::size_t q = 0; q < n_classes; ++q) ray.lx.push_back(per_m2 * run.flux[l * n_classes + q]);
    rays_[static_cast<std::size_t>(g)].push_back(std::move(ray));
  }
}

}  // namespace dim
