#include "transport/direct_columns.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace dim {
namespace {

// Paths between a cell and an opening along which light meets an off-specular cell, and facets it meets on
// each.
constexpr int kPaths = 16;
constexpr int kFacets = 32;

class Builder {
 public:
  Builder(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
          const ReflectanceClasses& classes, const Shine& shine, const Obstructions& obstructions,
          const std::vector<std::size_t>& source_of, std::size_t n_sources, int mirror_depth, bool in_the_way)
      : zone_(zone),
        cells_(cells),
        network_(network),
        lights_(lights),
        classes_(classes),
        shine_(shine),
        caster_(obstructions.caster()),
        source_of_(source_of),
        n_sources_(n_sources),
        mirror_depth_(shine.has_mirrors() ? mirror_depth : 0),
        emitters_(make_emitters(zone, lights, shine.mirrors(), mirror_depth_)),
        integrators_(make_integrators(zone, emitters_, obstructions, in_the_way)) {
    result_.n_columns = shine.has_mirrors() ? n_sources * classes.size() : n_sources;
    result_.cell.assign(cells.size() * result_.n_columns, 0.0);
    result_.point.assign(zone.points.size() * result_.n_columns, 0.0);
    lobe_lx_.assign(shine.n_off_specular() * emitters_.size(), 0.0);
    mirrored_.assign(shine.has_mirrors() ? cells.size() * n_all() : 0, 0.0);
    not_followed_.assign(mirrored_.size(), 0.0);
    escaped_.assign(mirrored_.size(), 0.0);
  }

  DirectColumns build(const Job& job) {
    direct_light(
        zone_, cells_, emitters_, integrators_,
        [&](std::size_t i, std::size_t e, const DirectEstimate& direct) { on_cell(i, e, direct.lx); },
        [&](std::size_t p, std::size_t e, const DirectEstimate& direct) {
          if (direct.lx > 0.0)
            add(&result_.point[p * result_.n_columns], zone_.points[p].position, e, direct.lx);
        },
        job);
    auto& shine = result_.shine;
    shine.mirrored.assign(n_all(), 0.0);
    shine.not_followed.assign(n_all(), 0.0);
    shine.escaped.assign(n_all(), 0.0);
    shine.point_lobe.assign(zone_.points.size() * n_all(), 0.0);
    for (std::size_t at = 0; at < mirrored_.size(); ++at) {
      shine.mirrored[at % n_all()] += mirrored_[at];
      shine.not_followed[at % n_all()] += not_followed_[at];
      shine.escaped[at % n_all()] += escaped_[at];
    }
    result_.n_images = emitters_.size() - lights_.luminaires.size();
    shine.psi.assign(shine_.n_states() * n_all(), 0.0F);
    if (shine_.n_off_specular() > 0) {
      fill_lobes(job);
      fill_points(job);
    }
    return std::move(result_);
  }

 private:
  std::size_t n_all() const { return n_sources_ * classes_.size(); }

  Vec3 middle(std::size_t cell) const {
    return zone_.surfaces[cells_.surface_of(cell)].polygon.frame().to_world(cells_[cell].centroid);
  }

  // What an emitter's mirrors leave of its light, by class.
  std::vector<double> tint(const Vec3& receiver, std::size_t e) const {
    const Emitter& emitter = emitters_[e];
    std::vector<double> tint(classes_.size(), 1.0);
    if (emitter.mirrors.empty()) return tint;
    const auto cosines = mirror_cosines(zone_, emitter, receiver, emitter.luminaire.at);
    for (std::size_t m = 0; m < cosines.size(); ++m) {
      const auto mirror = static_cast<std::size_t>(emitter.mirrors[cosines.size() - 1 - m]);
      for (std::size_t q = 0; q < tint.size(); ++q)
        tint[q] *= classes_.at(q, zone_.surfaces[mirror].finish).fresnel(cosines[m]);
    }
    return tint;
  }

  void add(double* columns, const Vec3& receiver, std::size_t e, double lx) const {
    const std::size_t s = source_of_[emitters_[e].original];
    if (!shine_.has_mirrors()) {
      columns[s] += lx;
      return;
    }
    const auto tints = tint(receiver, e);
    for (std::size_t q = 0; q < tints.size(); ++q) columns[q * n_sources_ + s] += tints[q] * lx;
  }

  void on_cell(std::size_t i, std::size_t e, double lx) {
    if (!(lx > 0.0)) return;
    add(&result_.cell[i * result_.n_columns], middle(i), e, lx);
    const Shininess kind = shine_.of_cell(i);
    if (kind == Shininess::off_specular)
      lobe_lx_[static_cast<std::size_t>(shine_.index_of(i)) * emitters_.size() + e] = lx;
    if (kind == Shininess::mirror) reflect_whole(i, e, lx);
  }

  // Paths along which an emitter's light meets a cell; one to its middle where none was found.
  std::vector<PairIntegrator::Path> paths_to(std::size_t cell, std::size_t e,
                                             const PairIntegrator& integrator, double& total) const {
    const Receiver receiver = cell_receiver(zone_, cells_, cell);
    const LowDiscrepancy4 chance(mix(cell) ^ mix(e));
    std::vector<PairIntegrator::Path> paths;
    total = 0.0;
    for (std::uint64_t i = 0; i < kPaths; ++i) {
      paths.push_back(integrator.path(receiver, chance(i)));
      total += paths.back().lx;
    }
    if (total > 0.0) return paths;
    const Vec3 at = middle(cell);
    total = 1.0;
    return {{at, glm::normalize(emitters_[e].luminaire.at - at), 1.0}};
  }

  void reflect_whole(std::size_t i, std::size_t e, double lx) {
    const auto& surface = zone_.surfaces[cells_.surface_of(i)];
    double total = 0.0;
    const auto paths = paths_to(i, e, integrators_[e], total);
    const auto tints = tint(middle(i), e);
    const bool last = static_cast<int>(emitters_[e].mirrors.size()) == mirror_depth_;
    const auto leaves = leaving(paths, surface.polygon.frame(), static_cast<int>(cells_.surface_of(i)));
    for (std::size_t q = 0; q < tints.size(); ++q) {
      double share = 0.0, gone = 0.0;
      for (std::size_t p = 0; p < paths.size(); ++p) {
        const double cosine = std::clamp(glm::dot(paths[p].towards, surface.polygon.frame().n), 0.0, 1.0);
        const double reflected = paths[p].lx / total * classes_.at(q, surface.finish).fresnel(cosine);
        share += reflected;
        if (leaves[p]) gone += reflected;
      }
      const std::size_t column = i * n_all() + q * n_sources_ + source_of_[emitters_[e].original];
      const double flux = cells_.area_m2(i) * lx * tints[q];
      (last ? not_followed_ : mirrored_)[column] += flux * share;
      if (!last) escaped_[column] += flux * gone;
    }
  }

  // Which of the paths a mirror sends out of the zone, or onto backs.
  std::vector<bool> leaving(const std::vector<PairIntegrator::Path>& paths, const Frame& frame,
                            int mirror) const {
    std::vector<bool> leaves;
    for (const auto& path : paths) {
      const Vec3 out = 2.0 * glm::dot(path.towards, frame.n) * frame.n - path.towards;
      const Hit hit = path.lx > 0.0 ? caster_.nearest(path.at, out, mirror) : Hit{};
      const auto plate = static_cast<std::size_t>(hit.plate);
      leaves.push_back(hit.plate < 0 || hit.back || plate >= zone_.surfaces.size() ||
                       zone_.surfaces[plate].outside);
    }
    return leaves;
  }

  void fill_lobes(const Job& job) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shine_.n_off_specular(), 4), [&](const auto& range) {
      if (job.stopped()) return;
      std::vector<double> psi;
      for (std::size_t g = range.begin(); g != range.end(); ++g) {
        psi.assign(shine_.grid().n_patches() * n_all(), 0.0);
        for (std::size_t e = 0; e < emitters_.size(); ++e) {
          const double lx = lobe_lx_[g * emitters_.size() + e];
          if (lx > 0.0) reflect_by_lobe(g, e, lx, integrators_[e], psi);
        }
        std::transform(psi.begin(), psi.end(),
                       result_.shine.psi.begin() + static_cast<std::ptrdiff_t>(g * psi.size()),
                       [](double x) { return static_cast<float>(x); });
      }
    });
    job.check();
  }

  // What measuring points see of direct light in lobes: along each of their rays at the exact angles, which
  // patches would smear.
  void fill_points(const Job& job) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, zone_.points.size(), 1), [&](const auto& range) {
      for (std::size_t p = range.begin(); p != range.end() && !job.stopped(); ++p) see_lobes(p);
    });
    job.check();
  }

  void see_lobes(std::size_t point) {
    const PatchGrid& patches = network_.point_patches;
    const RowRays rays(zone_, point, network_.sampling, network_.seed);
    double* columns = &result_.shine.point_lobe[point * n_all()];
    for (std::size_t patch = 0; patch < patches.n_patches(); ++patch) {
      const std::size_t sink = network_.point_sinks.at(point, patch);
      if (sink >= cells_.size() || shine_.of_cell(sink) != Shininess::off_specular) continue;
      const Ray ray = rays.ray(patches, patch);
      const double w =
          patches.weight_sr(static_cast<int>(patch / static_cast<std::size_t>(patches.n_sectors)));
      for (std::size_t e = 0; e < emitters_.size(); ++e) see_lobe(ray, sink, e, mix(patch), w, columns);
    }
  }

  void see_lobe(const Ray& ray, std::size_t cell, std::size_t e, std::uint64_t stream, double w,
                double* columns) const {
    if (!(lobe_lx_[static_cast<std::size_t>(shine_.index_of(cell)) * emitters_.size() + e] > 0.0)) return;
    const auto s = cells_.surface_of(cell);
    Frame frame = zone_.surfaces[s].polygon.frame();
    frame.origin = ray.from - frame.height(ray.from) / glm::dot(ray.direction, frame.n) * ray.direction;
    Vec3 out = -frame.direction_to_local(ray.direction);
    out.z = std::max(out.z, 1e-9);
    const Receiver receiver = point_receiver(frame, static_cast<int>(s), 0);
    const auto path =
        integrators_[e].path(receiver, LowDiscrepancy4(mix(e))(stream));
    if (!(path.lx > 0.0)) return;
    const Vec3 in = frame.direction_to_local(path.towards);
    const auto tints = tint(frame.origin, e);
    const int finish = zone_.surfaces[s].finish;
    const double lx = w * emitters_[e].luminaire.factor * path.lx;
    for (std::size_t q = 0; q < tints.size(); ++q)
      columns[q * n_sources_ + source_of_[emitters_[e].original]] +=
          lx * tints[q] * specular_brdf(classes_.at(q, finish), shine_.facets(finish), in, out);
  }

  // From the exact directions of the light, facet by facet, into patches; scaled to the exact albedo.
  void reflect_by_lobe(std::size_t g, std::size_t e, double lx, const PairIntegrator& integrator,
                       std::vector<double>& psi) const {
    const std::size_t cell = shine_.off_specular()[g];
    double total = 0.0;
    const auto paths = paths_to(cell, e, integrator, total);
    const auto tints = tint(middle(cell), e);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (paths[i].lx > 0.0)
        reflect_path(paths[i], lx * paths[i].lx / total, cell, i, mix(g) ^ mix(~e), e, tints, psi);
    }
  }

  void reflect_path(const PairIntegrator::Path& path, double lx, std::size_t cell, std::size_t index,
                    std::uint64_t stream, std::size_t e, const std::vector<double>& tints,
                    std::vector<double>& psi) const {
    const Surface& surface = zone_.surfaces[cells_.surface_of(cell)];
    Vec3 in = surface.polygon.frame().direction_to_local(path.towards);
    in.z = std::max(in.z, 1e-9);
    const LowDiscrepancy4 chance(stream);
    std::array<FacetSample, kFacets> facets;
    for (std::uint64_t f = 0; f < kFacets; ++f) {
      const auto x = chance(index * kFacets + f);
      facets[f] = sample_facet(shine_.facets(surface.finish), in, x[0], x[1]);
    }
    for (std::size_t q = 0; q < classes_.size(); ++q) {
      const auto& reflection = classes_.at(q, surface.finish);
      std::array<double, kFacets> share{};
      double sum = 0.0;
      for (std::size_t f = 0; f < kFacets; ++f) {
        if (facets[f].weight > 0.0) share[f] = facets[f].weight * reflection.fresnel(facets[f].facing);
        sum += share[f];
      }
      if (!(sum > 0.0)) continue;
      const double scale = lx * tints[q] * shine_.albedo(q, surface.finish).at(in.z) / sum;
      const std::size_t column = q * n_sources_ + source_of_[emitters_[e].original];
      for (std::size_t f = 0; f < kFacets; ++f) {
        if (share[f] > 0.0) psi[shine_.grid().patch_of(facets[f].out) * n_all() + column] += scale * share[f];
      }
    }
  }

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  const Lights& lights_;
  const ReflectanceClasses& classes_;
  const Shine& shine_;
  const RayCaster& caster_;
  const std::vector<std::size_t>& source_of_;
  std::size_t n_sources_;
  int mirror_depth_;
  std::vector<Emitter> emitters_;
  std::vector<PairIntegrator> integrators_;
  DirectColumns result_;
  std::vector<double> lobe_lx_;  // [n_off_specular, n_emitters]
  std::vector<double> mirrored_, not_followed_,
      escaped_;  // [n_cells, n_all]: cells of their own, summed in order
};

}  // namespace

DirectColumns direct_columns(const Zone& zone, const Cells& cells, const Network& network,
                             const Lights& lights, const ReflectanceClasses& classes, const Shine& shine,
                             const Obstructions& obstructions, const std::vector<std::size_t>& source_of,
                             std::size_t n_sources, int mirror_depth, bool in_the_way, const Job& job) {
  return Builder(zone, cells, network, lights, classes, shine, obstructions, source_of, n_sources, mirror_depth,
                 in_the_way)
      .build(job);
}

}  // namespace dim
