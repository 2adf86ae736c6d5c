#include "transport/assembly.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

float stored(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (!(value <= kMost)) return std::numeric_limits<float>::infinity();  // NaN as well; see check_storable
  return static_cast<float>(std::max(value, 0.0));
}

// Fills rows [source, class, i] from columns, each entry by `value(i, column)`.
template <typename Value>
std::vector<float> transposed(std::size_t n, std::size_t n_sources, std::size_t n_columns,
                              const Value& value) {
  std::vector<float> rows(n * n_columns);
  const std::size_t n_classes = n_sources ? n_columns / n_sources : 0;
  tbb::parallel_for(std::size_t{0}, n_columns, [&](std::size_t row) {
    const std::size_t column = row % n_classes * n_sources + row / n_classes;
    for (std::size_t i = 0; i < n; ++i) rows[row * n + i] = stored(value(i, column));
  });
  return rows;
}

}  // namespace

std::vector<float> rows_of_columns(const Columns<float>& columns, std::size_t n_rows, std::size_t n_sources) {
  return transposed(n_rows, n_sources, columns.n_columns(), [&](std::size_t i, std::size_t column) {
    return static_cast<double>(columns.value(i, column));
  });
}

std::vector<float> rows_of_states(const std::vector<float>& columns, const PatchGrid& grid,
                                  std::size_t n_sources, std::size_t n_columns) {
  const std::size_t n = n_columns ? columns.size() / n_columns : 0;
  const auto n_sectors = static_cast<std::size_t>(grid.n_sectors);
  return transposed(n, n_sources, n_columns, [&](std::size_t i, std::size_t column) {
    const double w = grid.weight_sr(static_cast<int>(i % grid.n_patches() / n_sectors));
    return static_cast<double>(columns[i * n_columns + column]) / w;
  });
}

void add_energy(Solution& solution, const std::vector<ColumnReport>& columns,
                const std::vector<FirstFlight>& flights, const std::vector<std::vector<double>>& class_flux_lm) {
  const std::size_t n_sources = solution.sources.size();
  for (std::size_t s = 0; s < n_sources; ++s) {
    Source& source = solution.sources[s];
    for (std::size_t b = 0; b < solution.bands.size(); ++b) {
      const std::size_t klass = solution.classes.of_band[b];
      const auto& column = columns[klass * n_sources + s];
      const double watts = source.watts_per_lumen(b);
      const double flux_lm = class_flux_lm[s].empty() ? source.flux_lm : class_flux_lm[s][klass];
      EnergyBalance energy;
      energy.emitted_W = flux_lm * watts;
      energy.absorbed_W = column.absorbed * watts;
      energy.escaped_W = (column.escaped + flights[s].escaped * flux_lm) * watts;
      energy.lost_W = flights[s].lost * flux_lm * watts;
      energy.dropped_W = column.dropped * watts;
      const double accounted = energy.absorbed_W + energy.escaped_W + energy.lost_W + energy.dropped_W;
      energy.imbalance = energy.emitted_W > 0.0 ? 1.0 - accounted / energy.emitted_W : 0.0;
      source.energy.push_back(energy);
      source.iterations = std::max(source.iterations, column.iterations);
      source.residual = std::max(source.residual, column.residual);
      source.error_bound = std::max(source.error_bound, column.error_bound);
    }
  }
}

void check_storable(const Solution& solution) {
  const std::size_t n_sources = solution.sources.size();
  for (const auto* rows : {&solution.cell_direct, &solution.cell_total, &solution.point_direct,
                           &solution.point_total, &solution.directional.direct, &solution.directional.total}) {
    const auto wrong = std::find_if(rows->begin(), rows->end(), [](float x) { return !std::isfinite(x); });
    if (wrong == rows->end()) continue;
    const auto at = static_cast<std::size_t>(wrong - rows->begin());
    throw InputError({{},
                      fmt::format("source '{}': its light is beyond {:.1e} lx at some place, more than a luminance "
                                  "database can hold",
                                  solution.sources[at / (rows->size() / n_sources)].name,
                                  static_cast<double>(std::numeric_limits<float>::max())),
                      "check the intensity, lumens and dim of its luminaires"});
  }
}

}  // namespace dim
