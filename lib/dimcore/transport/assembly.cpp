#include "transport/assembly.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

float stored(double value) {
  constexpr double kMost = static_cast<double>(std::numeric_limits<float>::max());
  if (!(value <= kMost)) return std::numeric_limits<float>::infinity();  // NaN as well; see check_storable
  return static_cast<float>(std::max(value, 0.0));
}

// Rows [source, class, i] from columns, each entry by `value(i, column)`.
template <typename Value>
std::vector<float> rows_of(std::size_t n, std::size_t n_sources, std::size_t n_columns, const Value& value) {
  std::vector<float> rows(n * n_columns);
  const std::size_t n_classes = n_sources ? n_columns / n_sources : 0;
  tbb::parallel_for(std::size_t{0}, n_columns, [&](std::size_t row) {
    const std::size_t column = row % n_classes * n_sources + row / n_classes;
    for (std::size_t i = 0; i < n; ++i) rows[row * n + i] = value(i, column);
  });
  return rows;
}

// The same of light.
template <typename Value>
std::vector<float> transposed(std::size_t n, std::size_t n_sources, std::size_t n_columns,
                              const Value& value) {
  return rows_of(n, n_sources, n_columns, [&](std::size_t i, std::size_t column) { return stored(value(i, column)); });
}

// Signed differences of points, or of the first `n` surfaces.
std::vector<float> differences(const Columns<float>& columns, std::size_t n, std::size_t n_sources) {
  return rows_of(n, n_sources, columns.n_columns(),
                 [&](std::size_t i, std::size_t column) { return columns.value(i, column); });
}

// Rows [source, class, i] of the first `n_rows` of a solver's columns class * n_sources + source.
std::vector<float> rows_of_columns(const Columns<float>& columns, std::size_t n_rows, std::size_t n_sources) {
  return transposed(n_rows, n_sources, columns.n_columns(), [&](std::size_t i, std::size_t column) {
    return static_cast<double>(columns.value(i, column));
  });
}

// The same of the zone's cells, as means over all of each: what bodies lie on is dark.
std::vector<float> rows_of_cells(const Columns<float>& columns, const Cells& cells, std::size_t n_rows,
                                 std::size_t n_sources) {
  return transposed(n_rows, n_sources, columns.n_columns(), [&](std::size_t i, std::size_t column) {
    return static_cast<double>(columns.value(i, column)) * cells.free_share(i);
  });
}

// The same of light by direction, from flux per area into each patch to its mean per solid angle.
std::vector<float> rows_of_states(const std::vector<float>& columns, const PatchGrid& grid,
                                  std::size_t n_sources, std::size_t n_columns) {
  const std::size_t n = n_columns ? columns.size() / n_columns : 0;
  const auto n_sectors = static_cast<std::size_t>(grid.n_sectors);
  return transposed(n, n_sources, n_columns, [&](std::size_t i, std::size_t column) {
    const double w = grid.weight_sr(static_cast<int>(i % grid.n_patches() / n_sectors));
    return static_cast<double>(columns[i * n_columns + column]) / w;
  });
}

// Fills the energy balance and the convergence figures of sources from the ends of the columns.
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

}  // namespace

Reflectances diffuse_reflectances(const Zone& zone, const ModelPlan& plan) {
  const std::size_t n_classes = plan.n_classes();
  Reflectances result{n_classes, std::vector<double>(zone.surfaces.size() * n_classes),
                      std::vector<std::size_t>(plan.n_columns())};
  for (std::size_t c = 0; c < plan.n_columns(); ++c) result.class_of_column[c] = c / plan.n_sources();
  for (std::size_t surface = 0; surface < zone.surfaces.size(); ++surface) {
    for (std::size_t q = 0; q < n_classes; ++q)
      result.of_surface[surface * n_classes + q] = plan.classes.at(q, zone.surfaces[surface].finish).diffuse;
  }
  return result;
}

Assembly::Assembly(const Room& room, const ModelPlan& plan, const Shine& shine, const Bands& bands)
    : plan_(plan), shine_(shine), cells_(room.cells), n_zone_surfaces_(room.n_zone_surfaces) {
  solution_.bands = bands;
  solution_.classes = plan.classes;
  solution_.sources = plan.sources;
  solution_.plan = plan;
  solution_.n_cells = room.n_zone_cells;
  solution_.n_points = room.n_points();
  solution_.directional.grid = shine.grid();
  solution_.directional.cells = shine.off_specular();
}

Assembly::DirectAsColumns Assembly::add_direct(const DirectColumns& direct) {
  const std::size_t n_sources = plan_.n_sources();
  solution_.n_direct_classes = direct.n_columns / n_sources;
  DirectAsColumns columns{Columns<float>::from_rows(direct.cell, direct.n_columns),
                          Columns<float>::from_rows(direct.point, direct.n_columns)};
  solution_.cell_direct = rows_of_cells(columns.cell, cells_, solution_.n_cells, n_sources);
  solution_.point_direct = rows_of_columns(columns.point, solution_.n_points, n_sources);
  solution_.directional.direct = rows_of_states(direct.shine.psi, shine_.grid(), n_sources, plan_.n_columns());
  point_direct_deviation_ =
      transposed(solution_.n_points, n_sources, direct.n_columns, [&](std::size_t i, std::size_t column) {
        return std::sqrt(direct.point_variance_lx2[i * direct.n_columns + column]);
      });
  surface_direct_deviation_ =
      transposed(n_zone_surfaces_, n_sources, direct.n_columns, [&](std::size_t s, std::size_t column) {
        return std::sqrt(direct.surface_variance_lx2[s * direct.n_columns + column]);
      });
  solution_.mirrors = direct.outcome;
  for (const double uncertain : direct.uncertain)
    solution_.mirrors.uncertain = std::max(solution_.mirrors.uncertain, uncertain);
  return columns;
}

void Assembly::add_total(Gathered<float> gathered, const DirectColumns& direct,
                         const std::vector<FirstFlight>& flights, const DaylightSources* daylight) {
  for (std::size_t c = 0; c < plan_.n_columns() && shine_.any(); ++c) {
    gathered.columns[c].absorbed -= direct.shine.mirrored[c] + direct.shine.not_followed[c];
    gathered.columns[c].dropped += direct.shine.not_followed[c];
    gathered.columns[c].escaped += direct.shine.escaped[c];
    gathered.columns[c].error_bound += direct.uncertain[c];
  }
  const std::size_t n_sources = plan_.n_sources();
  solution_.cell_total = rows_of_cells(gathered.cell, cells_, solution_.n_cells, n_sources);
  solution_.point_total = rows_of_columns(gathered.point, solution_.n_points, n_sources);
  if (gathered.point_cells.n_rows() > 0) {
    solution_.point_rays = differences(gathered.point_rays, solution_.n_points, n_sources);
    solution_.point_cells = differences(gathered.point_cells, solution_.n_points, n_sources);
    solution_.point_cell_rays = differences(gathered.point_cell_rays, solution_.n_points, n_sources);
    solution_.point_direct_deviation = std::move(point_direct_deviation_);
  }
  if (gathered.surface_cells.n_rows() > 0) {
    solution_.surface_cells = differences(gathered.surface_cells, n_zone_surfaces_, n_sources);
    solution_.surface_rays = differences(gathered.surface_rays, n_zone_surfaces_, n_sources);
    solution_.surface_direct_deviation = std::move(surface_direct_deviation_);
  }
  solution_.directional.total = rows_of_states(gathered.psi, shine_.grid(), n_sources, plan_.n_columns());
  solution_.counters["reflections"] = static_cast<double>(gathered.counts.reflections);
  solution_.counters["link_columns"] = static_cast<double>(gathered.counts.link_columns);
  std::vector<std::vector<double>> class_flux_lm(n_sources);
  if (daylight) {
    solution_.sky = daylight->record();
    daylight->take_flux(solution_.sources, class_flux_lm, gathered.columns);
  }
  add_energy(solution_, gathered.columns, flights, class_flux_lm);
}

Solution Assembly::finish() {
  check_storable(solution_);
  return std::move(solution_);
}

}  // namespace dim
