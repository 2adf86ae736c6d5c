#include "result/to_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "network/point_places.hpp"

namespace dim {
namespace {

constexpr int kMostRounds = 8;
constexpr double kMostRays = 1e9;
// Each part's share of what is asked for: the squares of four add up to it.
constexpr double kOfWhole = 0.5;
// By what parts fall, and how far one round goes.
constexpr double kCellOrder = 1.6, kRayOrder = 1.0;
constexpr double kLeastStep = 1.15, kMostStep = 4.0;

// How many times as many, or as fine, something has to be; 1 where it is good enough.
double step(double part, double due, double order) {
  if (part <= due) return 1.0;
  return std::clamp(std::pow(part / due, 1.0 / order), kLeastStep, kMostStep);
}

// Sectors stay even, so that half of the rays lie as evenly as all.
PatchGrid finer_grid(const PatchGrid& grid, double times) {
  if (times == 1.0) return grid;
  const double along = std::sqrt(times);
  return {static_cast<int>(std::ceil(along * grid.n_slices)),
          2 * static_cast<int>(std::ceil(along * grid.n_sectors / 2.0))};
}

void make_cells_smaller(Zone& zone, double times) {
  for (auto& surface : zone.surfaces) {
    surface.cell_m /= times;
    if (!surface.grid) continue;
    surface.grid->first = static_cast<int>(std::ceil(times * surface.grid->first));
    surface.grid->second = static_cast<int>(std::ceil(times * surface.grid->second));
  }
}

StatedShare stated_of(const RaysFile& rays, const Lights& lights, const SimulationOptions& options, const Job& job) {
  SimulationOptions together = options;
  together.combine = Combine::all;
  Warnings said_later;
  const LuminanceDatabase database(rays.zone, rays.cells, lights,
                                   simulate(rays.zone, rays.cells, rays.network, lights, together, job, said_later));
  const Mix mix(database.sources().size(), 1.0);
  const auto errors = point_errors(database, mix);
  if (!errors)
    throw InputError({{},
                      "the error of this room's light is not known: off-specular surfaces, daylight and --solver track "
                      "state none",
                      "leave out --accuracy and choose --cell and --patches"});
  const auto lx = point_illuminance_lx(database, mix);
  const bool lit = std::any_of(lx.begin(), lx.end(), [](double x) { return x > 0.0; });
  if (!lit)
    throw InputError({{}, "no measuring point is lit: there is nothing to be accurate at",
                      "give the zone a [[plane]] or [[sensors]] where there is light"});
  return stated_share(*errors, lx, rays.zone.points, {"", 0, rays.zone.points.size(), {}});
}

// A finer room: how many times as small its cells are, its rays.
struct Finer {
  double cells = 1.0;
  NetworkOptions options;
  double n_rays = 0.0;
};

double rays_of(double n_cells, const Zone& zone, const NetworkOptions& options) {
  return n_cells * static_cast<double>(options.patches.n_patches()) +
         static_cast<double>(zone.points.size() * options.point_patches.n_patches());
}

// What each part needs to be its share of the error; nothing where that is no finer room, or one too large.
std::optional<Finer> finer_room(const RaysFile& rays, const StatedShare& stated, double share, const Job& job) {
  constexpr double kOfCells = 1.8;  // the weight that the whole gives them, see PointError
  const double due = kOfWhole * share;
  Finer finer;
  finer.cells = step(kOfCells * stated.cells, due, kCellOrder);
  NetworkOptions& options = finer.options;
  options.patches = finer_grid(rays.network.patches, step(2.0 * stated.cell_rays, due, kRayOrder));
  options.point_patches = finer_grid(rays.network.point_patches, step(2.0 * stated.rays, due, kRayOrder));
  options.sampling = rays.network.sampling;
  options.seed = rays.network.seed;
  options.family = rays.network.has_family();
  const bool same = finer.cells == 1.0 && options.patches == rays.network.patches &&
                    options.point_patches == rays.network.point_patches;
  if (same) return std::nullopt;
  const double n_cells = static_cast<double>(rays.cells.size()) * finer.cells * finer.cells;
  finer.n_rays = rays_of(n_cells, rays.zone, options);
  if (finer.n_rays > kMostRays ||
      network_bytes(static_cast<std::size_t>(n_cells), rays.zone.points.size(), options) >
          static_cast<double>(job.memory_limit_bytes))
    return std::nullopt;
  return finer;
}

void make_finer(RaysFile& rays, const Finer& finer, const Job& job, ToAccuracy& result) {
  make_cells_smaller(rays.zone, finer.cells);
  rays.cells = Cells(rays.zone);
  rays.network = build_network(rays.zone, rays.cells, finer.options, job);
  judge_points(rays.network, rays.zone);
  result.cell_size /= finer.cells;
  ++result.n_networks;
}

// Lines past obstacles follow the tolerance, as the bound does. How many times as tight it has to be.
double tighter(const StatedShare& stated, double share) {
  return std::max(step(2.0 * stated.direct, kOfWhole * share, 1.0),
                  step(stated.bound, kOfWhole * kOfWhole * share, 1.0));
}

}  // namespace

ToAccuracy refine_to_accuracy(RaysFile& rays, const Lights& lights, SimulationOptions& options, double share,
                              const Job& job) {
  ToAccuracy result;
  for (int round = 0; round < kMostRounds; ++round) {
    const StatedShare stated = stated_of(rays, lights, options, job);
    result.stated = stated.total;
    result.tolerance = options.gather.tolerance;
    result.reached = stated.total <= share;
    if (result.reached) break;
    const double times = tighter(stated, share);
    options.gather.tolerance /= times;
    const auto finer = finer_room(rays, stated, share, job);
    if (finer)
      make_finer(rays, *finer, job, result);
    else if (times == 1.0)
      break;
  }
  return result;
}

ToAccuracy refine_within(RaysFile& rays, const Lights& lights, SimulationOptions& options, const TimeBudget& budget,
                         const Job& job) {
  // Sources apart take more than all as one: 2.6 times with 120 of them, measured.
  const double apart = 1.0 + 0.015 * static_cast<double>(lights.luminaires.size());
  double s_per_ray = 3e-7;  // of tracing, until it has been seen here
  ToAccuracy result;
  result.reached = true;
  for (;;) {
    const double before_s = budget.elapsed_s();
    const StatedShare stated = stated_of(rays, lights, options, job);
    const double solved_s = budget.elapsed_s() - before_s;
    result.stated = stated.total;
    result.tolerance = options.gather.tolerance;
    const double n_rays = rays_of(static_cast<double>(rays.cells.size()), rays.zone,
                                  {.patches = rays.network.patches, .point_patches = rays.network.point_patches});
    std::optional<Finer> finer;
    for (const double aim : {0.5, 0.6, 0.7, 0.8}) {
      finer = finer_room(rays, stated, aim * stated.total, job);
      if (!finer) continue;
      const double next_s = finer->n_rays * (s_per_ray + solved_s / n_rays * (1.0 + apart));
      if (budget.elapsed_s() + next_s <= budget.seconds) {
        options.gather.tolerance /= tighter(stated, aim * stated.total);
        break;
      }
      finer.reset();
    }
    if (!finer) return result;
    const double began_s = budget.elapsed_s();
    make_finer(rays, *finer, job, result);
    s_per_ray = (budget.elapsed_s() - began_s) / finer->n_rays;
  }
}

}  // namespace dim
