#include "result/point_error.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

// Adds factor times what a source's part holds by class, weighted as its light is.
bool add_part(const LuminanceDatabase& database, TransferPart part, std::size_t source, double factor,
              std::vector<double>& to) {
  const auto values = database.transfer(part, source);
  if (values.size() < to.size()) return to.empty();
  const auto xyz = database.sources()[source].xyz_by_class(database.classes());
  // Direct light that no mirror colours is the same in all classes.
  const std::size_t n_stored = to.empty() ? 1 : values.size() / to.size();
  for (std::size_t q = 0; q < xyz.size(); ++q) {
    for (std::size_t p = 0; p < to.size(); ++p)
      to[p] += factor * xyz[q].y * static_cast<double>(values[q % n_stored * to.size() + p]);
  }
  return true;
}

// One lucky pair of halves does not make an error of zero: half of the square is that of the others of its set.
void pool(const PointSet& set, const std::vector<double>& lx, double PointError::*part, std::vector<PointError>& errors) {
  const auto square = [](double x) { return x * x; };
  double squares = 0.0, n = 0.0;
  for (std::size_t p = set.first; p < set.first + set.count; ++p) {
    if (!(lx[p] > 0.0)) continue;
    squares += square(errors[p].*part / lx[p]);
    n += 1.0;
  }
  for (std::size_t p = set.first; p < set.first + set.count && n > 0.0; ++p)
    errors[p].*part = std::sqrt(0.5 * (square(errors[p].*part) + squares / n * square(lx[p])));
}

// The value that 95 % of them do not exceed.
double percentile(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

}  // namespace

double PointError::total_lx() const {
  constexpr double kOfCells = 0.8;
  return bound_lx + 2.0 * std::sqrt(kOfCells * cells_lx * cells_lx + rays_lx * rays_lx + cell_rays_lx * cell_rays_lx +
                                    direct_lx * direct_lx);
}

std::optional<std::vector<PointError>> point_errors(const LuminanceDatabase& database, const Mix& mix) {
  const std::size_t n = database.zone().points.size();
  std::vector<double> cells(n, 0.0), rays(n, 0.0), cell_rays(n, 0.0), direct_squares(n, 0.0), bound(n, 0.0);
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    if (database.sources()[s].daylight) return std::nullopt;  // how far rays through windows are off is not known
    std::vector<double> direct(n, 0.0), lx(n, 0.0);
    if (!add_part(database, TransferPart::point_cells, s, mix[s], cells) ||
        !add_part(database, TransferPart::point_rays, s, mix[s], rays) ||
        !add_part(database, TransferPart::point_cell_rays, s, mix[s], cell_rays) ||
        !add_part(database, TransferPart::point_direct_deviation, s, mix[s], direct))
      return std::nullopt;
    add_part(database, TransferPart::point_total, s, mix[s], lx);
    for (std::size_t p = 0; p < n; ++p) {
      direct_squares[p] += direct[p] * direct[p];
      bound[p] += database.sources()[s].error_bound * lx[p];
    }
  }
  std::vector<PointError> errors(n);
  for (std::size_t p = 0; p < n; ++p)
    errors[p] = {std::abs(cells[p]), std::abs(rays[p]), std::abs(cell_rays[p]), std::sqrt(direct_squares[p]), bound[p]};
  const auto lx = point_illuminance_lx(database, mix);
  for (const auto& set : database.zone().point_sets) {
    pool(set, lx, &PointError::rays_lx, errors);
    pool(set, lx, &PointError::cell_rays_lx, errors);
  }
  return errors;
}

StatedShare stated_share(const std::vector<PointError>& errors, const std::vector<double>& lx,
                         const std::vector<MeasuringPoint>& points, const PointSet& of) {
  const auto share_of = [&](auto&& value) {
    std::vector<double> shares;
    for (std::size_t p = of.first; p < of.first + of.count; ++p)
      if (points[p].valid && lx[p] > 0.0) shares.push_back(value(errors[p]) / lx[p]);
    return percentile(std::move(shares));
  };
  StatedShare stated;
  stated.total = share_of([](const PointError& e) { return e.total_lx(); });
  stated.cells = share_of([](const PointError& e) { return e.cells_lx; });
  stated.rays = share_of([](const PointError& e) { return e.rays_lx; });
  stated.cell_rays = share_of([](const PointError& e) { return e.cell_rays_lx; });
  stated.direct = share_of([](const PointError& e) { return e.direct_lx; });
  stated.bound = share_of([](const PointError& e) { return e.bound_lx; });
  return stated;
}

std::optional<std::vector<PointError>> surface_errors(const LuminanceDatabase& database, const Mix& mix,
                                                      const std::vector<SurfaceFigures>& figures) {
  const std::size_t n = database.zone().surfaces.size();
  std::vector<double> cells(n, 0.0), rays(n, 0.0), direct_squares(n, 0.0);
  double bound = 0.0;
  for (std::size_t s = 0; s < mix.size(); ++s) {
    if (mix[s] == 0.0) continue;
    const auto& source = database.sources()[s];
    std::vector<double> direct(n, 0.0);
    if (source.daylight || !add_part(database, TransferPart::surface_cells, s, mix[s], cells) ||
        !add_part(database, TransferPart::surface_rays, s, mix[s], rays) ||
        !add_part(database, TransferPart::surface_direct_deviation, s, mix[s], direct))
      return std::nullopt;
    for (std::size_t i = 0; i < n; ++i) direct_squares[i] += direct[i] * direct[i];
    bound = std::max(bound, source.error_bound);
  }
  std::vector<double> mean_lx;
  std::vector<PointError> errors(n);
  for (std::size_t i = 0; i < n; ++i) {
    mean_lx.push_back(figures[i].illuminance_mean_lx);
    errors[i] = {.cells_lx = std::abs(cells[i]), .cell_rays_lx = std::abs(rays[i]),
                 .direct_lx = std::sqrt(direct_squares[i]), .bound_lx = bound * mean_lx[i]};
  }
  PointSet all;
  all.count = n;
  pool(all, mean_lx, &PointError::cell_rays_lx, errors);
  return errors;
}

std::optional<SurfaceLight> surface_light(const LuminanceDatabase& database, const Mix& mix) {
  const auto figures = surface_figures(database.cells(), cell_appearance(database, database.cells(), mix));
  const auto errors = surface_errors(database, mix, figures);
  if (!errors) return std::nullopt;
  SurfaceLight light;
  for (std::size_t s = 0; s < figures.size(); ++s) {
    light.lm += figures[s].area_m2 * figures[s].illuminance_mean_lx;
    light.error_lm += figures[s].area_m2 * (*errors)[s].total_lx();
  }
  return light;
}

PointError mean_error(const std::vector<PointError>& errors, const std::vector<MeasuringPoint>& points,
                      const PointSet& set) {
  PointError mean;
  double n = 0.0;
  for (std::size_t p = set.first; p < set.first + set.count; ++p) {
    if (!points[p].valid) continue;
    mean.cells_lx += errors[p].cells_lx;
    mean.cell_rays_lx += errors[p].cell_rays_lx;
    mean.rays_lx += errors[p].rays_lx * errors[p].rays_lx;
    mean.direct_lx += errors[p].direct_lx * errors[p].direct_lx;
    mean.bound_lx += errors[p].bound_lx;
    n += 1.0;
  }
  if (n == 0.0) return mean;
  return {mean.cells_lx / n, std::sqrt(mean.rays_lx) / n, mean.cell_rays_lx / n, std::sqrt(mean.direct_lx) / n, mean.bound_lx / n};
}

}  // namespace dim
