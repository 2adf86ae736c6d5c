#include "result/to_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "network/point_places.hpp"

namespace dim {
namespace {

constexpr double kOfPoints = 0.95;
constexpr int kMostRounds = 8;
constexpr double kMostRays = 1e9;
// Each part's share of what is asked for: the squares of four add up to it.
constexpr double kOfWhole = 0.5;
// By what parts fall, and how far one round goes.
constexpr double kCellOrder = 1.6, kRayOrder = 1.0;
constexpr double kLeastStep = 1.15, kMostStep = 4.0;

double percentile(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(std::ceil(kOfPoints * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

// How many times as many, or as fine, something has to be; 1 where it is good enough.
double step(double part, double due, double order) {
  if (part <= due) return 1.0;
  return std::clamp(std::pow(part / due, 1.0 / order), kLeastStep, kMostStep);
}

PatchGrid finer(const PatchGrid& grid, double times) {
  const double along = std::sqrt(times);
  return {static_cast<int>(std::ceil(along * grid.n_slices)), static_cast<int>(std::ceil(along * grid.n_sectors))};
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
  return stated_share(*errors, lx, rays.zone.points);
}

// The finer room; whether there is a finer one that is not too large.
bool refine(RaysFile& rays, const StatedShare& stated, double share, const Job& job, ToAccuracy& result) {
  constexpr double kOfCells = 1.8;  // the weight that the whole gives them, see PointError
  const double due = kOfWhole * share;
  const double cells = step(kOfCells * stated.cells, due, kCellOrder);
  NetworkOptions options;
  options.patches = finer(rays.network.patches, step(2.0 * stated.cell_rays, due, kRayOrder));
  options.point_patches = finer(rays.network.point_patches, step(2.0 * stated.rays, due, kRayOrder));
  options.sampling = rays.network.sampling;
  options.seed = rays.network.seed;
  options.family = rays.network.has_family();
  const bool same = cells == 1.0 && options.patches == rays.network.patches &&
                    options.point_patches == rays.network.point_patches;
  if (same) return false;
  const double n_cells = static_cast<double>(rays.cells.size()) * cells * cells;
  const double n_rays = n_cells * static_cast<double>(options.patches.n_patches()) +
                        static_cast<double>(rays.zone.points.size() * options.point_patches.n_patches());
  if (n_rays > kMostRays || network_bytes(static_cast<std::size_t>(n_cells), rays.zone.points.size(), options) >
                                static_cast<double>(job.memory_limit_bytes))
    return false;
  make_cells_smaller(rays.zone, cells);
  rays.cells = Cells(rays.zone);
  rays.network = build_network(rays.zone, rays.cells, options, job);
  judge_points(rays.network, rays.zone);
  result.cell_size /= cells;
  ++result.n_networks;
  return true;
}

}  // namespace

StatedShare stated_share(const std::vector<PointError>& errors, const std::vector<double>& lx,
                         const std::vector<MeasuringPoint>& points) {
  const auto of = [&](auto&& value) {
    std::vector<double> shares;
    for (std::size_t p = 0; p < errors.size(); ++p)
      if (points[p].valid && lx[p] > 0.0) shares.push_back(value(errors[p]) / lx[p]);
    return percentile(std::move(shares));
  };
  StatedShare stated;
  stated.total = of([](const PointError& e) { return e.total_lx(); });
  stated.cells = of([](const PointError& e) { return e.cells_lx; });
  stated.rays = of([](const PointError& e) { return e.rays_lx; });
  stated.cell_rays = of([](const PointError& e) { return e.cell_rays_lx; });
  stated.direct = of([](const PointError& e) { return e.direct_lx; });
  stated.bound = of([](const PointError& e) { return e.bound_lx; });
  return stated;
}

ToAccuracy refine_to_accuracy(RaysFile& rays, const Lights& lights, SimulationOptions& options, double share,
                              const Job& job) {
  ToAccuracy result;
  for (int round = 0; round < kMostRounds; ++round) {
    const StatedShare stated = stated_of(rays, lights, options, job);
    result.stated = stated.total;
    result.tolerance = options.gather.tolerance;
    result.reached = stated.total <= share;
    if (result.reached) break;
    // Lines past obstacles follow the tolerance, as the bound does.
    const double tighter = std::max(step(2.0 * stated.direct, kOfWhole * share, 1.0),
                                    step(stated.bound, kOfWhole * kOfWhole * share, 1.0));
    options.gather.tolerance /= tighter;
    if (!refine(rays, stated, share, job, result) && tighter == 1.0) break;
  }
  return result;
}

}  // namespace dim
