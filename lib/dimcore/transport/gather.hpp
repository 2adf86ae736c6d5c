#pragma once

#include <vector>

#include "base/job.hpp"
#include "network/cells.hpp"
#include "network/network.hpp"
#include "transport/shine.hpp"
#include "transport/shine_state.hpp"

namespace dim {

struct GatherOptions {
  double tolerance = 3e-4;  ///< stop when no cell changes by more than this share of its column's mean
  int max_iterations = 1000;
};

/// How one column (a source in a reflectance class) ended. All power figures in the unit of direct
/// illuminance times square metres.
struct ColumnReport {
  int iterations = 0;
  double residual = 0.0;     ///< largest last change of a cell over the column's mean irradiance
  double error_bound = 0.0;  ///< contraction bound residual * rho_max / (1 - rho_max)
  double received = 0.0;     ///< direct, on cells
  double absorbed = 0.0;     ///< by cells
  double escaped = 0.0;      ///< reflected out of the zone or onto backs
  double dropped = 0.0;      ///< the last change's reflections, not followed; either sign
};

struct Gathered {
  std::vector<double> cell;   ///< [n_cells, n_columns] total irradiance
  std::vector<double> point;  ///< [n_points, n_columns]
  std::vector<float> psi;     ///< [n_states, n_columns] of off-specular cells, see `Shine`; empty without any
  std::vector<ColumnReport> columns;
};

/// Shiny surfaces of the problem.
struct GatherShine {
  const Shine& shine;
  const Zone& zone;
  const DirectShine& direct;
  std::vector<std::size_t> class_of_column;  ///< [n_columns]
};

/// Solves E_i = E0_i + sum_j F_ij rho_j E_j for all columns at once and gathers the measuring points.
///
/// @param direct       [n_cells, n_columns] E0; unit free
/// @param point_direct [n_points, n_columns]
/// @param reflectance  [n_surfaces, n_columns], each in [0, 1)
/// @param shine        null where every surface is diffusing
/// @throws Interrupted
Gathered gather(const Network& network, const Cells& cells, const std::vector<double>& direct,
                const std::vector<double>& point_direct, const std::vector<double>& reflectance,
                std::size_t n_columns, const GatherOptions& options, const Job& job,
                const GatherShine* shine = nullptr);

/// What measuring points receive from cells whose irradiances are known: the last step of a solution.
/// [n_points, n_columns]
/// @param cell  [n_cells, n_columns] total irradiance; @param psi  [n_states, n_columns], empty without lobes
std::vector<double> gather_points(const Network& network, const Cells& cells, const std::vector<double>& cell,
                                  const std::vector<float>& psi, const std::vector<double>& point_direct,
                                  const std::vector<double>& reflectance, std::size_t n_columns,
                                  const GatherShine* shine);

}  // namespace dim
