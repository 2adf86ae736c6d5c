#include "transport/direct_columns.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <span>

#include "transport/cell_light.hpp"
#include "transport/direct_lobes.hpp"
#include "transport/mirrored_light.hpp"
#include "transport/point_images.hpp"

namespace dim {
namespace {

// Images that cells have of one luminaire: beyond the first order they end where another order would bring
// them above the former, which is where rays become the cheaper way; never above the latter, of all together.
constexpr std::size_t kManyImages = 100;
constexpr std::size_t kMostImages = 100'000;
// Rays that a luminaire's whole light would be followed by, for each cell; and at most, of all together.
constexpr double kRaysPerCell = 4000.0;
constexpr double kMostRays = 1e7;

// The images of one order, of all luminaires. Integrators point at emitters: it stays where it is.
struct Order {
  std::vector<Emitter> emitters;
  std::vector<PairIntegrator> integrators;
};

class Builder {
 public:
  Builder(const Zone& zone, const Cells& cells, const Network& network, const Lights& lights,
          const ReflectanceClasses& classes, const Shine& shine, const Obstructions& obstructions,
          const std::vector<std::size_t>& source_of, std::size_t n_sources, const MirrorOptions& options,
          bool in_the_way)
      : zone_(zone),
        cells_(cells),
        network_(network),
        lights_(lights),
        classes_(classes),
        shine_(shine),
        obstructions_(obstructions),
        source_of_(source_of),
        n_sources_(n_sources),
        options_(options),
        in_the_way_(in_the_way),
        mirrored_(zone, cells, classes, shine, obstructions.caster(), source_of, n_sources, in_the_way),
        on_lobes_(shine.n_off_specular()),
        on_mirrors_(shine.has_mirrors() ? cells.size() : 0) {
    result_.n_columns = shine.has_mirrors() ? n_all() : n_sources;
    result_.cell.assign(cells.size() * result_.n_columns, 0.0);
    result_.point.assign(zone.points.size() * result_.n_columns, 0.0);
    result_.mirror_depth.assign(lights.luminaires.size(), 0);
    result_.uncertain.assign(n_all(), 0.0);
  }

  DirectColumns build(const Job& job) {
    add_luminaires(job);
    if (shine_.has_mirrors()) add_images(job);
    auto& shine = result_.shine;
    shine.mirrored = mirrored_.reflected();
    shine.escaped = mirrored_.escaped();
    shine.not_followed = mirrored_.not_followed();
    result_.followed = std::move(mirrored_.brought());
    result_.n_rays = mirrored_.n_rays();
    add_lobes(job);
    if (shine_.has_mirrors()) add_point_images(job);
    return std::move(result_);
  }

 private:
  std::size_t n_all() const { return n_sources_ * classes_.size(); }
  std::size_t n_luminaires() const { return lights_.luminaires.size(); }
  double flux_lm(std::size_t luminaire) const {
    const auto& l = lights_.luminaires[luminaire];
    return l.factor * lights_.fittings[static_cast<std::size_t>(l.fitting)].intensity.flux_lm();
  }

  void add(double* columns, const Emitter& emitter, const Vec3& receiver, double lx) const {
    const std::size_t s = source_of_[emitter.original];
    if (!shine_.has_mirrors()) {
      columns[s] += lx;
      return;
    }
    const auto tints = tints_of(zone_, classes_, emitter, receiver);
    for (std::size_t q = 0; q < tints.size(); ++q) columns[q * n_sources_ + s] += tints[q] * lx;
  }

  Order& new_order(std::vector<Emitter> emitters) {
    orders_.push_back(std::make_unique<Order>());
    Order& order = *orders_.back();
    order.emitters = std::move(emitters);
    order.integrators = make_integrators(zone_, order.emitters, obstructions_, in_the_way_);
    return order;
  }

  void on_cell(const CellLight& light) {
    if (!(light.lx > 0.0)) return;
    add(&result_.cell[light.cell * result_.n_columns], *light.emitter, middle_of(zone_, cells_, light.cell),
        light.lx);
    const Shininess kind = shine_.of_cell(light.cell);
    if (kind == Shininess::off_specular)
      on_lobes_[static_cast<std::size_t>(shine_.index_of(light.cell))].push_back(light);
    if (kind == Shininess::mirror) on_mirrors_[light.cell].push_back(light);
  }

  void add_luminaires(const Job& job) {
    const Order& own = new_order(own_emitters(lights_, in_the_way_));
    own_point_lx_.assign(zone_.points.size() * n_luminaires(), 0.0);
    direct_light(
        zone_, cells_, own.emitters, own.integrators,
        [&](std::size_t i, std::size_t e, const DirectEstimate& direct) {
          on_cell({i, &own.emitters[e], &own.integrators[e], direct.lx});
        },
        [&](std::size_t p, std::size_t e, const DirectEstimate& direct) {
          own_point_lx_[p * n_luminaires() + e] = direct.lx;
          add(&result_.point[p * result_.n_columns], own.emitters[e], zone_.points[p].position, direct.lx);
        },
        job);
  }

  void add_images(const Job& job) {
    const MirrorImages images(zone_, shine_.mirrors());
    std::vector<std::size_t> n_images(n_luminaires(), 0);
    for (int depth = 0; !orders_.back()->emitters.empty(); ++depth) {
      const auto lights = take_mirror_lights();
      std::vector<double> reflected_lm(n_luminaires(), 0.0);
      for (const auto& light : lights) reflected_lm[light.emitter->original] += mirrored_.reflected_lm(light);
      std::vector<bool> goes_on(n_luminaires(), false);
      std::vector<Emitter> next;
      for (std::size_t l = 0; l < n_luminaires(); ++l) {
        auto some = next_images(images, l, depth, n_images[l], reflected_lm[l]);
        if (!some) continue;
        goes_on[l] = true;
        result_.mirror_depth[l] += !some->empty();
        n_images[l] += some->size();
        std::move(some->begin(), some->end(), std::back_inserter(next));
      }
      std::vector<CellLight> passed_on, followed;
      for (const auto& light : lights)
        (goes_on[light.emitter->original] ? passed_on : followed).push_back(light);
      mirrored_.pass_on(passed_on, job);
      mirrored_.follow(followed, ray_lm(reflected_lm), job);
      add_order(new_order(std::move(next)), job);
    }
    result_.n_images = std::accumulate(n_images.begin(), n_images.end(), std::size_t{0});
  }

  // Images of a luminaire's latest ones; nothing where rays are to go on.
  std::optional<std::vector<Emitter>> next_images(const MirrorImages& images, std::size_t luminaire,
                                                  int depth, std::size_t n_before,
                                                  double reflected_lm) const {
    std::size_t most = kMostImages / n_luminaires();
    if (options_.depth) {
      if (depth >= *options_.depth) return std::nullopt;
    } else {
      if (reflected_lm <= options_.tolerance * flux_lm(luminaire)) return std::nullopt;
      if (depth > 0) most = std::min(most, kManyImages);
    }
    std::vector<Emitter> latest;
    for (const auto& emitter : orders_.back()->emitters) {
      if (emitter.original == luminaire) latest.push_back(emitter);
    }
    return images.of(latest, most - std::min(most, n_before));
  }

  // Direct light of the latest order on mirror cells, cell by cell.
  std::vector<CellLight> take_mirror_lights() {
    std::vector<CellLight> lights;
    for (auto& on_cell : on_mirrors_) {
      lights.insert(lights.end(), on_cell.begin(), on_cell.end());
      on_cell.clear();
    }
    return lights;
  }

  std::vector<double> ray_lm(const std::vector<double>& reflected_lm) const {
    std::vector<double> lm;
    for (std::size_t l = 0; l < n_luminaires(); ++l)
      lm.push_back(std::max({flux_lm(l) / (kRaysPerCell * static_cast<double>(cells_.size())),
                             reflected_lm[l] * static_cast<double>(n_luminaires()) / kMostRays,
                             std::numeric_limits<double>::min()}));
    return lm;
  }

  void add_order(const Order& order, const Job& job) {
    const double tolerance_m = 1e-9 * zone_.diameter_m;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end() && !job.stopped(); ++i) {
        const Receiver receiver = cell_receiver(zone_, cells_, i);
        const std::span corners(receiver.ring.begin(), receiver.ring.end());
        for (std::size_t e = 0; e < order.emitters.size(); ++e) {
          const auto& emitter = order.emitters[e];
          if (emitter.beam.misses(corners, tolerance_m)) continue;
          on_cell({i, &emitter, &order.integrators[e],
                   emitter.luminaire.factor * order.integrators[e].mean(receiver).lx});
        }
      }
    });
    job.check();
  }

  void add_lobes(const Job& job) {
    const DirectLobes lobes(zone_, cells_, network_, classes_, shine_, source_of_, n_sources_, on_lobes_,
                            mirrored_.rays());
    result_.shine.psi = lobes.psi_of_emitters(job);
    const bool any_rays = std::any_of(mirrored_.rays().begin(), mirrored_.rays().end(),
                                      [](const auto& rays) { return !rays.empty(); });
    if (any_rays) result_.followed_psi = lobes.psi_of_rays(job);
    result_.shine.point_lobe = lobes.at_points(result_.followed_psi, job);
  }

  void add_point_images(const Job& job) {
    std::vector<double> source_lm(n_sources_, 0.0);
    for (std::size_t l = 0; l < n_luminaires(); ++l) source_lm[source_of_[l]] += flux_lm(l);
    for (std::size_t s = 0; s < n_sources_; ++s) {
      if (source_lm[s] > 0.0)
        result_.followed_share = std::max(result_.followed_share, mirrored_.sent_lm()[s] / source_lm[s]);
    }
    if (zone_.points.empty()) return;
    const auto images =
        point_images(zone_, lights_, classes_, shine_.mirrors(), obstructions_, source_of_, n_sources_,
                     own_point_lx_, in_the_way_, {options_.tolerance, options_.depth}, job);
    result_.n_images = std::max(result_.n_images, images.n);
    const auto mean_lx = column_means();
    for (std::size_t at = 0; at < images.lx.size(); ++at) {
      const std::size_t c = at % n_all();
      result_.point[at] += images.lx[at];
      const double of_lx = std::max(result_.point[at], mean_lx[c]);
      if (of_lx > 0.0) result_.uncertain[c] = std::max(result_.uncertain[c], images.uncertain_lx[at] / of_lx);
    }
    // Of a luminaire without any image nothing is known but what its light on mirrors is.
    for (std::size_t l = 0; l < n_luminaires(); ++l) {
      const std::size_t s = source_of_[l];
      for (std::size_t q = 0; q < classes_.size() && images.depth[l] == 0 && source_lm[s] > 0.0; ++q)
        result_.uncertain[q * n_sources_ + s] =
            std::max(result_.uncertain[q * n_sources_ + s], mirrored_.sent_lm()[s] / source_lm[s]);
    }
  }

  std::vector<double> column_means() const {
    std::vector<double> mean(n_all(), 0.0);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      area_m2 += cells_.area_m2(i);
      for (std::size_t c = 0; c < n_all(); ++c) mean[c] += cells_.area_m2(i) * result_.cell[i * n_all() + c];
    }
    for (double& m : mean) m /= area_m2;
    return mean;
  }

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  const Lights& lights_;
  const ReflectanceClasses& classes_;
  const Shine& shine_;
  const Obstructions& obstructions_;
  const std::vector<std::size_t>& source_of_;
  std::size_t n_sources_;
  MirrorOptions options_;
  bool in_the_way_;
  std::vector<std::unique_ptr<Order>> orders_;
  MirroredLight mirrored_;
  DirectColumns result_;
  std::vector<std::vector<CellLight>> on_lobes_;    // [n_off_specular]
  std::vector<std::vector<CellLight>> on_mirrors_;  // [n_cells] of the latest order
  std::vector<double> own_point_lx_;                // [n_points, n_luminaires]
};

}  // namespace

bool DirectColumns::add_followed() {
  if (followed.empty() && followed_psi.empty()) return false;
  for (std::size_t i = 0; i < followed.size(); ++i) cell[i] += followed[i];
  for (std::size_t i = 0; i < followed_psi.size(); ++i) shine.psi[i] += followed_psi[i];
  followed.clear();
  followed_psi.clear();
  return true;
}

DirectColumns direct_columns(const Zone& zone, const Cells& cells, const Network& network,
                             const Lights& lights, const ReflectanceClasses& classes, const Shine& shine,
                             const Obstructions& obstructions, const std::vector<std::size_t>& source_of,
                             std::size_t n_sources, const MirrorOptions& mirrors, bool in_the_way,
                             const Job& job) {
  return Builder(zone, cells, network, lights, classes, shine, obstructions, source_of, n_sources, mirrors,
                 in_the_way)
      .build(job);
}

}  // namespace dim
