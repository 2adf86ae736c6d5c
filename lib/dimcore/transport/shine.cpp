#include "transport/shine.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace dim {
namespace {

constexpr std::size_t kNoPoint = ~std::size_t{0};
constexpr double kNothingLeft = 1e-5;  // of a ray's weight after mirrors

}  // namespace

// What one row found, with tints of its own: the first is 1.
struct Shine::RowLinks {
  std::vector<MirrorLink> mirror;
  std::vector<LobeLink> lobe;
  std::vector<std::uint32_t> lobe_receiver;  // of each lobe link
  std::vector<double> tints;
  double cut_off = 0.0;
};

Shine::Shine(const Zone& zone, const Cells& cells, const Network& network, const ReflectanceClasses& classes,
             const RayCaster& caster, int depth, const Job& job)
    : zone_(zone),
      cells_(cells),
      network_(network),
      classes_(classes),
      depth_(depth),
      grid_(lobe_grid(network.patches)),
      n_classes_(classes.size()),
      index_of_(cells.size(), -1),
      tints_(n_classes_, 1.0) {
  const auto of_finish = shininess_of_finishes(zone, classes, grid_);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto kind =
        zone.surfaces[s].outside ? Shininess::diffusing : of_finish[at(zone.surfaces[s].finish)];
    of_surface_.push_back(kind);
    if (kind == Shininess::mirror) mirrors_.push_back(static_cast<int>(s));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (of_cell(i) != Shininess::off_specular) continue;
    index_of_[i] = static_cast<std::int32_t>(off_specular_.size());
    off_specular_.push_back(static_cast<std::uint32_t>(i));
  }
  if (!any()) return;
  make_optics(classes, of_finish);

  const std::size_t n_cells = cells.size(), n_points = zone.points.size();
  const auto receivers = rows(n_cells + n_points, job, [&](RowLinks& links, std::size_t row) {
    const bool point = row >= n_cells;
    const std::size_t index = point ? row - n_cells : row;
    const RowRays rays = point ? RowRays(zone, index, network.sampling, network.seed)
                               : RowRays(zone, cells, index, network.sampling, network.seed);
    const SinkTable& sinks = point ? network.point_sinks : network.sinks;
    follow_mirrors(
        links, rays, point ? network.point_patches : network.patches,
        [&](std::size_t patch) { return sinks.at(index, patch); }, point ? row : kNoPoint, caster);
  });
  const auto sources = rows(off_specular_.size(), job,
                            [&](RowLinks& links, std::size_t index) { send_lobes(links, index, caster); });

  mirror_first_.assign(n_cells + n_points + 1, 0);
  lobe_first_.assign(n_cells + n_points + 1, 0);
  for (const auto& row : sources) {
    for (const auto receiver : row.lobe_receiver) ++lobe_first_[receiver + 1];
  }
  for (std::size_t row = 0; row < receivers.size(); ++row) {
    const auto shift = keep_tints(receivers[row]);
    for (auto link : receivers[row].mirror) {
      link.tint += link.tint ? shift : 0;
      mirror_links_.push_back(link);
    }
    mirror_first_[row + 1] = mirror_links_.size();
    lobe_first_[row + 1] += receivers[row].lobe.size();
    cut_off_ += receivers[row].cut_off / static_cast<double>(receivers.size());
  }
  for (std::size_t row = 0; row < receivers.size(); ++row) lobe_first_[row + 1] += lobe_first_[row];
  lobe_links_.resize(lobe_first_.back());
  auto next = lobe_first_;
  const auto place = [&](const RowLinks& row, std::uint32_t shift) {
    for (std::size_t l = 0; l < row.lobe.size(); ++l) {
      auto link = row.lobe[l];
      link.tint += link.tint ? shift : 0;
      lobe_links_[next[row.lobe_receiver[l]]++] = link;
    }
  };
  for (const auto& row : sources) place(row, keep_tints(row));
  for (std::size_t p = n_cells; p < receivers.size(); ++p) place(receivers[p], keep_tints(receivers[p]));
}

void Shine::make_optics(const ReflectanceClasses& classes, const std::vector<Shininess>& of_finish) {
  const std::size_t n_finishes = zone_.finishes.size();
  lobes_.assign(n_classes_, std::vector<std::shared_ptr<const LobeMatrix>>(n_finishes));
  albedos_.assign(n_classes_, std::vector<std::shared_ptr<const AlbedoTable>>(n_finishes));
  slice_albedos_.assign(n_classes_, std::vector<std::shared_ptr<const std::vector<double>>>(n_finishes));
  facets_.resize(n_finishes);
  for (std::size_t f = 0; f < n_finishes; ++f) {
    if (of_finish[f] == Shininess::diffusing) continue;
    const Finish& finish = zone_.finishes[f];
    LobeShape shape;
    if (of_finish[f] == Shininess::off_specular) {
      facets_[f] = std::make_unique<Facets>(facet_distribution(finish), finish.roughness);
      shape = lobe_shape(grid_, *facets_[f]);
    }
    for (std::size_t q = 0; q < n_classes_; ++q) {
      const BandReflection& reflection = classes.of_finish[q][f];
      std::size_t same = 0;
      while (same < q && !(classes.of_finish[same][f] == reflection)) ++same;
      if (same < q) {
        albedos_[q][f] = albedos_[same][f];
        slice_albedos_[q][f] = slice_albedos_[same][f];
        lobes_[q][f] = lobes_[same][f];
        continue;
      }
      albedos_[q][f] = std::make_shared<AlbedoTable>(reflection, facets_[f].get());
      slice_albedos_[q][f] = std::make_shared<std::vector<double>>(albedos_[q][f]->of_slices(grid_));
      if (facets_[f]) lobes_[q][f] = std::make_shared<LobeMatrix>(shape, reflection, *slice_albedos_[q][f]);
    }
  }
}

template <class MakeRow>
std::vector<Shine::RowLinks> Shine::rows(std::size_t n, const Job& job, MakeRow&& make_row) const {
  std::vector<RowLinks> result(n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 16), [&](const auto& range) {
    for (std::size_t row = range.begin(); row != range.end() && !job.stopped(); ++row) {
      result[row].tints.assign(n_classes_, 1.0);
      make_row(result[row], row);
    }
  });
  job.check();
  return result;
}

std::uint32_t Shine::keep_tints(const RowLinks& row) {
  const auto shift = static_cast<std::uint32_t>(tints_.size() / n_classes_) - 1;
  tints_.insert(tints_.end(), row.tints.begin() + static_cast<std::ptrdiff_t>(n_classes_), row.tints.end());
  return shift;
}

std::size_t Shine::lobe_patch(std::size_t network_patch) const {
  const auto sectors = static_cast<std::size_t>(network_.patches.n_sectors);
  const auto factor = sectors / static_cast<std::size_t>(grid_.n_sectors);
  return network_patch / sectors / factor * static_cast<std::size_t>(grid_.n_sectors) +
         network_patch % sectors / factor;
}

std::uint32_t Shine::patch_in(std::size_t cell, const Vec3& direction) const {
  const std::size_t surface = cells_.surface_of(cell);
  if (of_surface_[surface] == Shininess::diffusing) return 0;
  Vec3 local = -zone_.surfaces[surface].polygon.frame().direction_to_local(direction);
  local.z = std::max(local.z, 1e-9);
  return static_cast<std::uint32_t>(grid_.patch_of(local));
}

std::uint32_t Shine::state_towards(std::size_t cell, const Vec3& direction) const {
  return static_cast<std::uint32_t>(static_cast<std::size_t>(index_of_[cell]) * grid_.n_patches()) +
         patch_in(cell, direction);
}

double Shine::lobe_share(const PatchGrid& patches, std::size_t patch, std::size_t lobe_patch) const {
  const int slice = static_cast<int>(patch / static_cast<std::size_t>(patches.n_sectors));
  const int lobe_slice = static_cast<int>(lobe_patch / static_cast<std::size_t>(grid_.n_sectors));
  return patches.weight_sr(slice) / grid_.weight_sr(lobe_slice);
}

// Calls on_landing(cell, direction, tint by class, mirrors met) wherever a ray comes down, mirrors included.
// @returns true if the last landing was a mirror whose light was not followed
template <class OnLanding>
bool Shine::follow(const Ray& ray, int skip, const RayCaster& caster, OnLanding&& on_landing) const {
  std::vector<double> tint(n_classes_, 1.0);
  Vec3 from = ray.from, direction = ray.direction;
  for (int met = 0;; ++met) {
    const Hit hit = caster.nearest(from, direction, skip);
    if (hit.plate < 0 || hit.back) return false;
    const auto s = static_cast<std::size_t>(hit.plate);
    if (s >= zone_.surfaces.size() || zone_.surfaces[s].outside) return false;
    const Surface& surface = zone_.surfaces[s];
    const std::size_t cell = cells_.cell_hit(s, hit.local, direction);
    on_landing(cell, direction, tint, met);
    if (of_surface_[s] != Shininess::mirror) return false;
    if (met == depth_) return true;
    const Vec3& n = surface.polygon.frame().n;
    const double cosine = std::clamp(-glm::dot(direction, n), 0.0, 1.0);
    double left = 0.0;
    for (std::size_t q = 0; q < n_classes_; ++q) {
      tint[q] *= classes_.at(q, surface.finish).fresnel(cosine);
      left = std::max(left, tint[q]);
    }
    if (left < kNothingLeft) return false;
    from += hit.t * direction;
    direction = glm::normalize(direction + 2.0 * cosine * n);
    skip = hit.plate;
  }
}

void Shine::follow_mirrors(RowLinks& links, const RowRays& rays, const PatchGrid& patches,
                           const Sink& sink_of, std::size_t point_row, const RayCaster& caster) const {
  const bool to_point = point_row != kNoPoint;
  for (std::size_t patch = 0; patch < patches.n_patches(); ++patch) {
    const std::size_t sink = sink_of(patch);
    if (sink >= cells_.size()) continue;
    const Shininess kind = of_cell(sink);
    if (kind == Shininess::diffusing || (kind == Shininess::off_specular && !to_point)) continue;
    const Ray ray = rays.ray(patches, patch);
    const double w = patches.weight_sr(static_cast<int>(patch / static_cast<std::size_t>(patches.n_sectors)));
    const auto seen_lobe = [&](std::size_t cell, const Vec3& direction, std::uint32_t tint) {
      const auto state = state_towards(cell, direction);
      const auto lobe_slice = state % grid_.n_patches() / static_cast<std::size_t>(grid_.n_sectors);
      links.lobe.push_back(
          {state, 0, tint, static_cast<float>(w / grid_.weight_sr(static_cast<int>(lobe_slice)))});
      links.lobe_receiver.push_back(static_cast<std::uint32_t>(point_row));
    };
    if (kind == Shininess::off_specular) {
      seen_lobe(sink, ray.direction, 0);
      continue;
    }
    const bool cut =
        follow(ray, rays.skip(), caster,
               [&](std::size_t cell, const Vec3& direction, const std::vector<double>& tint, int met) {
                 if (met == 0) return;
                 links.tints.insert(links.tints.end(), tint.begin(), tint.end());
                 const auto own = static_cast<std::uint32_t>(links.tints.size() / n_classes_ - 1);
                 links.mirror.push_back({static_cast<std::uint32_t>(patch), static_cast<std::uint32_t>(cell),
                                         patch_in(cell, direction), own});
                 if (to_point && index_of_[cell] >= 0) seen_lobe(cell, direction, own);
               });
    if (cut) links.cut_off += w / kPi;
  }
}

void Shine::send_lobes(RowLinks& links, std::size_t index, const RayCaster& caster) const {
  const std::size_t source = off_specular_[index];
  const RowRays rays(zone_, cells_, source, network_.sampling, network_.seed);
  const double area_m2 = cells_.area_m2(source);
  for (std::size_t patch = 0; patch < network_.patches.n_patches(); ++patch) {
    const std::size_t sink = network_.sinks.at(source, patch);
    if (sink >= cells_.size()) continue;
    const std::size_t out = lobe_patch(patch);
    const auto state = static_cast<std::uint32_t>(index * grid_.n_patches() + out);
    const double share = lobe_share(network_.patches, patch, out) * area_m2;
    const auto add = [&](std::size_t cell, std::uint32_t in, std::uint32_t tint) {
      links.lobe.push_back({state, in, tint, static_cast<float>(share / cells_.area_m2(cell))});
      links.lobe_receiver.push_back(static_cast<std::uint32_t>(cell));
    };
    if (of_cell(sink) == Shininess::diffusing) {
      add(sink, 0, 0);
      continue;
    }
    const Ray ray = rays.ray(network_.patches, patch);
    if (of_cell(sink) == Shininess::off_specular) {
      add(sink, patch_in(sink, ray.direction), 0);
      continue;
    }
    follow(ray, rays.skip(), caster,
           [&](std::size_t cell, const Vec3& direction, const std::vector<double>& tint, int met) {
             std::uint32_t own = 0;
             if (met > 0) {
               links.tints.insert(links.tints.end(), tint.begin(), tint.end());
               own = static_cast<std::uint32_t>(links.tints.size() / n_classes_ - 1);
             }
             add(cell, patch_in(cell, direction), own);
           });
  }
}

}  // namespace dim
