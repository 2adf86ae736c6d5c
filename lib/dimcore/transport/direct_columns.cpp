#include "transport/direct_columns.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <span>

#include "light/direct_light.hpp"
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

// The images of one order, of all luminaires. Integrators point at sources: it stays where it is.
struct Order {
  std::vector<LightSource> sources;
  std::vector<PairIntegrator> integrators;
};

class Builder {
 public:
  Builder(const Room& room, const ModelPlan& plan, const Shine& shine, const MirrorOptions& options)
      : room_(room),
        plan_(plan),
        shine_(shine),
        options_(options),
        n_lit_(plan.source_of.empty() ? 0 : *std::max_element(plan.source_of.begin(), plan.source_of.end()) + 1),
        mirrored_(room, plan, shine),
        on_lobes_(shine.n_off_specular()),
        on_mirrors_(plan.has_mirrors ? room.cells.size() : 0) {
    result_.n_columns = plan.n_direct_columns();
    result_.cell.assign(room.cells.size() * result_.n_columns, 0.0);
    result_.point.assign(room.n_points() * result_.n_columns, 0.0);
    result_.point_variance_lx2.assign(result_.point.size(), 0.0);
    result_.surface_variance_lx2.assign(room.zone.surfaces.size() * result_.n_columns, 0.0);
    result_.outcome.depth.assign(room.n_luminaires(), 0);
    result_.outcome.rays_cut_off = shine.cut_off();
    result_.uncertain.assign(plan.n_columns(), 0.0);
  }

  DirectColumns build(const Job& job) {
    add_luminaires(job);
    if (plan_.has_mirrors) add_images(job);
    auto& shine = result_.shine;
    shine.mirrored = mirrored_.reflected();
    shine.escaped = mirrored_.escaped();
    shine.not_followed = mirrored_.not_followed();
    result_.followed = std::move(mirrored_.brought());
    result_.outcome.n_rays = mirrored_.n_rays();
    add_lobes(job);
    if (plan_.has_mirrors) add_point_images(job);
    return std::move(result_);
  }

 private:
  std::size_t n_all() const { return plan_.n_columns(); }
  std::size_t n_luminaires() const { return room_.n_luminaires(); }
  double flux_lm(std::size_t luminaire) const { return orders_.front()->sources[luminaire].power_lm(); }

  void add(double* columns, const LightSource& source, const Vec3& receiver, double lx) const {
    const std::size_t s = plan_.source_of[source.original];
    if (!plan_.has_mirrors) {
      columns[s] += lx;
      return;
    }
    const auto tints = tints_of(room_.zone, plan_.classes, source, receiver);
    for (std::size_t q = 0; q < tints.size(); ++q) columns[plan_.column(s, q)] += tints[q] * lx;
  }

  Order& new_order(std::vector<LightSource> sources) {
    orders_.push_back(std::make_unique<Order>());
    Order& order = *orders_.back();
    order.sources = std::move(sources);
    order.integrators = make_integrators(room_.zone, order.sources, room_.obstructions, plan_.pairs());
    return order;
  }

  void on_cell(CellLight light) {
    if (!(light.lx > 0.0)) return;
    light.lx /= room_.cells.free_share(light.cell);
    add(&result_.cell[light.cell * result_.n_columns], light.source(), middle_of(room_, light.cell),
        light.lx);
    const Shininess kind = shine_.of_cell(light.cell);
    if (kind == Shininess::off_specular)
      on_lobes_[static_cast<std::size_t>(shine_.index_of(light.cell))].push_back(light);
    if (kind == Shininess::mirror) on_mirrors_[light.cell].push_back(light);
  }

  void add_luminaires(const Job& job) {
    const Order& own = new_order(own_sources(room_.zone, room_.lights, plan_.tests_visibility));
    own_point_lx_.assign(room_.zone.points.size() * n_luminaires(), 0.0);
    std::vector<float> of_cells(room_.cells.size() * n_lit_, 0.0F);
    direct_light(
        room_.zone, room_.cells, own.integrators,
        [&](std::size_t i, std::size_t e, const DirectEstimate& direct) {
          on_cell({i, &own.integrators[e], direct.lx});
          const double area_m2 = room_.cells[i].area_m2;
          of_cells[i * n_lit_ + plan_.source_of[e]] +=
              static_cast<float>(area_m2 * area_m2 * direct.variance_lx2);
        },
        [&](std::size_t p, std::size_t e, const DirectEstimate& direct) {
          own_point_lx_[p * n_luminaires() + e] = direct.lx;
          add(&result_.point[p * result_.n_columns], own.sources[e], room_.zone.points[p].position, direct.lx);
          // Luminaires have no mirrors before them: no tints.
          for (std::size_t c = plan_.source_of[e]; c < result_.n_columns; c += plan_.n_sources())
            result_.point_variance_lx2[p * result_.n_columns + c] += direct.variance_lx2;
        },
        job);
    add_surface_variance(of_cells);
  }

  // @param of_cells  [n_cells, n_lit_] times the square of their area
  void add_surface_variance(const std::vector<float>& of_cells) {
    for (std::size_t s = 0; s < room_.cells.n_surfaces(); ++s) {
      double area_m2 = 0.0;
      for (std::size_t i = room_.cells.first(s); i < room_.cells.first(s + 1); ++i) area_m2 += room_.cells[i].area_m2;
      double* to = &result_.surface_variance_lx2[s * result_.n_columns];
      for (std::size_t i = room_.cells.first(s); i < room_.cells.first(s + 1); ++i)
        for (std::size_t first = 0; first < result_.n_columns; first += plan_.n_sources())
          for (std::size_t lit = 0; lit < n_lit_; ++lit)
            to[first + lit] += static_cast<double>(of_cells[i * n_lit_ + lit]) / (area_m2 * area_m2);
    }
  }

  void add_images(const Job& job) {
    const MirrorImages images(room_.zone, shine_.mirrors());
    std::vector<std::size_t> n_images(n_luminaires(), 0);
    for (int depth = 0; !orders_.back()->sources.empty(); ++depth) {
      const auto lights = take_mirror_lights();
      std::vector<double> reflected_lm(n_luminaires(), 0.0);
      for (const auto& light : lights) reflected_lm[light.source().original] += mirrored_.reflected_lm(light);
      std::vector<bool> goes_on(n_luminaires(), false);
      std::vector<LightSource> next;
      for (std::size_t l = 0; l < n_luminaires(); ++l) {
        auto some = next_images(images, l, depth, n_images[l], reflected_lm[l]);
        if (!some) continue;
        goes_on[l] = true;
        result_.outcome.depth[l] += !some->empty();
        n_images[l] += some->size();
        std::move(some->begin(), some->end(), std::back_inserter(next));
      }
      std::vector<CellLight> passed_on, followed;
      for (const auto& light : lights)
        (goes_on[light.source().original] ? passed_on : followed).push_back(light);
      mirrored_.pass_on(passed_on, job);
      mirrored_.follow(followed, ray_lm(reflected_lm), job);
      add_order(new_order(std::move(next)), job);
    }
    result_.outcome.n_images = std::accumulate(n_images.begin(), n_images.end(), std::size_t{0});
  }

  // Images of a luminaire's latest ones; nothing where rays are to go on.
  std::optional<std::vector<LightSource>> next_images(const MirrorImages& images, std::size_t luminaire,
                                                  int depth, std::size_t n_before,
                                                  double reflected_lm) const {
    std::size_t most = kMostImages / n_luminaires();
    if (options_.depth) {
      if (depth >= *options_.depth) return std::nullopt;
    } else {
      if (reflected_lm <= options_.tolerance * flux_lm(luminaire)) return std::nullopt;
      if (depth > 0) most = std::min(most, kManyImages);
    }
    std::vector<LightSource> latest;
    for (const auto& source : orders_.back()->sources) {
      if (source.original == luminaire) latest.push_back(source);
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
      lm.push_back(std::max({flux_lm(l) / (kRaysPerCell * static_cast<double>(room_.cells.size())),
                             reflected_lm[l] * static_cast<double>(n_luminaires()) / kMostRays,
                             std::numeric_limits<double>::min()}));
    return lm;
  }

  void add_order(const Order& order, const Job& job) {
    const double tolerance_m = 1e-9 * room_.zone.diameter_m;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, room_.cells.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end() && !job.stopped(); ++i) {
        const Receiver receiver = cell_receiver(room_.zone, room_.cells, i);
        const std::span corners(receiver.ring.begin(), receiver.ring.end());
        for (std::size_t e = 0; e < order.sources.size(); ++e) {
          const auto& source = order.sources[e];
          if (source.beam.misses(corners, tolerance_m)) continue;
          on_cell({i, &order.integrators[e], source.luminaire.factor * order.integrators[e].mean(receiver).lx});
        }
      }
    });
    job.check();
  }

  void add_lobes(const Job& job) {
    const DirectLobes lobes(room_, plan_, shine_, on_lobes_, mirrored_.rays());
    result_.shine.psi = lobes.psi_of_sources(job);
    const bool any_rays = std::any_of(mirrored_.rays().begin(), mirrored_.rays().end(),
                                      [](const auto& rays) { return !rays.empty(); });
    if (any_rays) result_.followed_psi = lobes.psi_of_rays(job);
    result_.shine.point_lobe = lobes.at_points(result_.followed_psi, job);
  }

  void add_point_images(const Job& job) {
    std::vector<double> source_lm(plan_.n_sources(), 0.0);
    for (std::size_t l = 0; l < n_luminaires(); ++l) source_lm[plan_.source_of[l]] += flux_lm(l);
    for (std::size_t s = 0; s < plan_.n_sources(); ++s) {
      if (source_lm[s] > 0.0)
        result_.outcome.rays_share = std::max(result_.outcome.rays_share, mirrored_.sent_lm()[s] / source_lm[s]);
    }
    if (room_.zone.points.empty()) return;
    const auto images =
        point_images(room_, plan_, shine_.mirrors(), own_point_lx_, {options_.tolerance, options_.depth}, job);
    result_.outcome.n_images = std::max(result_.outcome.n_images, images.n);
    const auto mean_lx = column_means();
    for (std::size_t at = 0; at < images.lx.size(); ++at) {
      const std::size_t c = at % n_all();
      result_.point[at] += images.lx[at];
      const double of_lx = std::max(result_.point[at], mean_lx[c]);
      if (of_lx > 0.0) result_.uncertain[c] = std::max(result_.uncertain[c], images.uncertain_lx[at] / of_lx);
    }
    // Of a luminaire without any image nothing is known but what its light on mirrors is.
    for (std::size_t l = 0; l < n_luminaires(); ++l) {
      const std::size_t s = plan_.source_of[l];
      for (std::size_t q = 0; q < plan_.n_classes() && images.depth[l] == 0 && source_lm[s] > 0.0; ++q)
        result_.uncertain[plan_.column(s, q)] =
            std::max(result_.uncertain[plan_.column(s, q)], mirrored_.sent_lm()[s] / source_lm[s]);
    }
  }

  std::vector<double> column_means() const {
    std::vector<double> mean(n_all(), 0.0);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < room_.cells.size(); ++i) {
      area_m2 += room_.cells.area_m2(i);
      for (std::size_t c = 0; c < n_all(); ++c) mean[c] += room_.cells.area_m2(i) * result_.cell[i * n_all() + c];
    }
    for (double& m : mean) m /= area_m2;
    return mean;
  }

  const Room& room_;
  const ModelPlan& plan_;
  const Shine& shine_;
  MirrorOptions options_;
  const std::size_t n_lit_;  // sources of luminaires: the first ones, those of daylight follow
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

DirectColumns direct_columns(const Room& room, const ModelPlan& plan, const Shine& shine,
                             const MirrorOptions& mirrors, const Job& job) {
  return Builder(room, plan, shine, mirrors).build(job);
}

}  // namespace dim
