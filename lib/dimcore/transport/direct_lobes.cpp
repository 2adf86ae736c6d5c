#include "transport/direct_lobes.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dim {
namespace {

// Paths between a cell and an opening along which light comes in, by how far their directions spread over the
// lobe's width; and facets it meets on each, so many that they make up a lobe however few the paths.
constexpr int kLeastPaths = 2, kMostPaths = 16;
constexpr std::size_t kFacets = 32, kLeastFacets = 128, kMostFacets = kLeastFacets / kLeastPaths;

int n_paths(const Room& room, const CellLight& light) {
  const auto& cell = room.cells[light.cell];
  const auto finish = static_cast<std::size_t>(room.surface_of(light.cell).finish);
  const double m = room.zone.finishes[finish].roughness;
  const double extent_m =
      glm::length(cell.high - cell.low) + largest_dimension_m(light.source().luminaire.opening);
  const double distance_m = glm::length(light.source().luminaire.at - middle_of(room, light.cell));
  const double spread = extent_m / (distance_m * lobe_half_width_rad(m));
  return static_cast<int>(
      std::clamp(std::ceil(kMostPaths * spread * spread), double{kLeastPaths}, double{kMostPaths}));
}

}  // namespace

// Light on a cell from one direction.
struct DirectLobes::Coming {
  std::size_t cell;
  Vec3 towards;  // where it comes from
  std::size_t source;
  const std::vector<double>& lx;  // [n_classes]
  std::uint64_t stream;
  std::size_t n_facets;
};

DirectLobes::DirectLobes(const Room& room, const ModelPlan& plan, const Shine& shine,
                         const std::vector<std::vector<CellLight>>& of_sources,
                         const std::vector<std::vector<RayLight>>& of_rays)
    : room_(room), plan_(plan), shine_(shine), of_sources_(of_sources), of_rays_(of_rays) {}

template <class Reflect>
std::vector<float> DirectLobes::psi(const Job& job, Reflect&& reflect) const {
  std::vector<float> result(shine_.n_states() * n_all(), 0.0F);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shine_.n_off_specular(), 4), [&](const auto& range) {
    std::vector<double> of_cell;
    for (std::size_t g = range.begin(); g != range.end() && !job.stopped(); ++g) {
      of_cell.assign(shine_.grid().n_patches() * n_all(), 0.0);
      reflect(g, of_cell);
      std::transform(of_cell.begin(), of_cell.end(),
                     result.begin() + static_cast<std::ptrdiff_t>(g * of_cell.size()),
                     [](double x) { return static_cast<float>(x); });
    }
  });
  job.check();
  return result;
}

std::vector<float> DirectLobes::psi_of_sources(const Job& job) const {
  return psi(job, [&](std::size_t g, std::vector<double>& of_cell) {
    for (const auto& light : of_sources_[g]) reflect_source(light, of_cell);
  });
}

std::vector<float> DirectLobes::psi_of_rays(const Job& job) const {
  return psi(job, [&](std::size_t g, std::vector<double>& of_cell) {
    const std::size_t cell = shine_.off_specular()[g];
    for (std::size_t r = 0; r < of_rays_[g].size(); ++r) {
      const RayLight& ray = of_rays_[g][r];
      reflect({cell, -ray.direction, ray.source, ray.lx, mix(g), kFacets}, r, of_cell);
    }
  });
}

void DirectLobes::reflect_source(const CellLight& light, std::vector<double>& psi) const {
  const int n = n_paths(room_, light);
  const std::size_t n_facets = std::max(kFacets, kLeastFacets / static_cast<std::size_t>(n));
  const auto paths = paths_of(room_, light, n);
  const auto tints = tints_of(room_.zone, plan_.classes, light.source(), middle_of(room_, light.cell));
  std::vector<double> lx(tints.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!(paths[i].lx > 0.0)) continue;
    for (std::size_t q = 0; q < tints.size(); ++q) lx[q] = light.lx * paths[i].lx * tints[q];
    reflect({light.cell, paths[i].towards, plan_.source_of[light.source().original], lx,
             mix(light.cell) ^ light.source().stream, n_facets},
            i, psi);
  }
}

// From the exact direction of the light, facet by facet, into patches; scaled to the exact albedo.
void DirectLobes::reflect(const Coming& coming, std::size_t index, std::vector<double>& psi) const {
  const Surface& surface = room_.surface_of(coming.cell);
  Vec3 in = surface.polygon.frame().direction_to_local(coming.towards);
  in.z = std::max(in.z, 1e-9);
  const LowDiscrepancy4 chance(coming.stream);
  std::array<FacetSample, kMostFacets> facets;
  for (std::uint64_t f = 0; f < coming.n_facets; ++f) {
    const auto x = chance(index * coming.n_facets + f);
    facets[f] = sample_facet(shine_.facets(surface.finish), in, x[0], x[1]);
  }
  for (std::size_t q = 0; q < plan_.classes.size(); ++q) {
    const auto& reflection = plan_.classes.at(q, surface.finish);
    std::array<double, kMostFacets> share{};
    double sum = 0.0;
    for (std::size_t f = 0; f < coming.n_facets; ++f) {
      if (facets[f].weight > 0.0) share[f] = facets[f].weight * reflection.fresnel(facets[f].facing);
      sum += share[f];
    }
    if (!(sum > 0.0)) continue;
    const double scale = coming.lx[q] * shine_.albedo(q, surface.finish).at(in.z) / sum;
    const std::size_t column = plan_.column(coming.source, q);
    for (std::size_t f = 0; f < coming.n_facets; ++f) {
      if (share[f] > 0.0) psi[shine_.grid().patch_of(facets[f].out) * n_all() + column] += scale * share[f];
    }
  }
}

std::vector<double> DirectLobes::at_points(const std::vector<float>& psi_of_rays, const Job& job) const {
  std::vector<double> result(room_.zone.points.size() * n_all(), 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, room_.zone.points.size(), 1), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end() && !job.stopped(); ++p)
      see(p, psi_of_rays, &result[p * n_all()]);
  });
  job.check();
  return result;
}

void DirectLobes::see(std::size_t point, const std::vector<float>& psi_of_rays, double* columns) const {
  const PatchGrid& patches = room_.network.point_patches;
  const auto n_sectors = static_cast<std::size_t>(patches.n_sectors);
  const RowRays rays(room_.zone, point, room_.network.sampling, room_.network.seed);
  for (std::size_t patch = 0; patch < patches.n_patches(); ++patch) {
    const std::size_t sink = room_.network.point_sinks.at(point, patch);
    if (sink >= room_.cells.size() || shine_.of_cell(sink) != Shininess::off_specular) continue;
    const auto g = static_cast<std::size_t>(shine_.index_of(sink));
    const Ray ray = rays.ray(patches, patch);
    const double w = patches.weight_sr(static_cast<int>(patch / n_sectors));
    for (const auto& light : of_sources_[g]) see(ray, light, mix(patch), w, columns);
    if (psi_of_rays.empty()) continue;
    const std::size_t seen = shine_.states().patch_in(sink, ray.direction);
    const auto slice = static_cast<int>(seen / static_cast<std::size_t>(shine_.grid().n_sectors));
    const float* psi = &psi_of_rays[(g * shine_.grid().n_patches() + seen) * n_all()];
    for (std::size_t c = 0; c < n_all(); ++c)
      columns[c] += w / shine_.grid().weight_sr(slice) * static_cast<double>(psi[c]);
  }
}

void DirectLobes::see(const Ray& ray, const CellLight& light, std::uint64_t stream, double w,
                      double* columns) const {
  const auto s = room_.cells.surface_of(light.cell);
  Frame frame = room_.zone.surfaces[s].polygon.frame();
  frame.origin = ray.from - frame.height(ray.from) / glm::dot(ray.direction, frame.n) * ray.direction;
  Vec3 out = -frame.direction_to_local(ray.direction);
  out.z = std::max(out.z, 1e-9);
  const Receiver receiver = point_receiver(frame, static_cast<int>(s), 0);
  const auto path = light.integrator->path(receiver,
                                           LowDiscrepancy4(light.source().stream)(stream));
  if (!(path.lx > 0.0)) return;
  const Vec3 in = frame.direction_to_local(path.towards);
  const auto tints = tints_of(room_.zone, plan_.classes, light.source(), frame.origin);
  const int finish = room_.zone.surfaces[s].finish;
  const double lx = w * light.source().luminaire.factor * path.lx;
  for (std::size_t q = 0; q < tints.size(); ++q)
    columns[plan_.column(plan_.source_of[light.source().original], q)] +=
        lx * tints[q] * specular_brdf(plan_.classes.at(q, finish), shine_.facets(finish), in, out);
}

}  // namespace dim
