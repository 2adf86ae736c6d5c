#pragma once

#include <cstdint>
#include <vector>

#include "base/job.hpp"
#include "network/cells.hpp"
#include "network/network.hpp"
#include "transport/column_report.hpp"
#include "transport/columns.hpp"
#include "transport/propagation.hpp"

namespace dim {

struct GatherOptions {
  /// Stop when one more reflection changes no reflecting cell by more than this share of its own irradiance
  /// (of kIrradianceFloor times its column's mean, where it has less).
  double tolerance = 3e-4;
  int max_iterations = 1000;  ///< reflections through the network
  /// Take off what the cells' size does to the light, see `CellSmoothing`; not where there are lobes.
  bool corrects_cell_size = true;
};

/// Work done.
struct GatherCounts {
  std::uint64_t reflections = 0;   ///< of blocks of columns through the network
  std::uint64_t link_columns = 0;  ///< rays times columns read for it
};

template <class Real>
struct Gathered {
  Columns<Real> cell;      ///< [n_cells, n_columns] total irradiance
  Columns<Real> point;     ///< [n_points, n_columns]
  std::vector<float> psi;  ///< [n_states, n_columns] of off-specular cells, see `Shine`; empty without any
  Columns<Real> point_cells;  ///< [n_points, n_columns] what the correction for the cells' size has added; empty
                              ///< where there is none
  Columns<Real> point_rays;   ///< [n_points, n_columns] what every other ray of the points alone changes
  /// [n_points, n_columns] what every other ray of the cells that points see changes; empty with lobes
  Columns<Real> point_cell_rays;
  /// [n_surfaces, n_columns] the same of the means of surfaces: what the correction for the cells' size has added, and
  /// what every other ray of their cells changes; empty where the others are
  Columns<Real> surface_cells, surface_rays;
  std::vector<ColumnReport> columns;
  GatherCounts counts;
};

/// Solves E_i = E0_i + sum_j F_ij rho_j E_j for all columns at once and gathers the measuring points.
///
/// By conjugate residuals (see `ConjugateResiduals`) around the true residual: whatever has been calculated in
/// single precision or with lobes of an earlier state is seen by the next full reflection, and the last one is
/// the result. Where conjugate residuals gain nothing, plain reflections go on, which always converge. A column's
/// result does not depend on the others, and cells that no light reaches stay exactly 0.
///
/// Cells too large for their light make an error that falls with their size to the power of 1.6: half of what
/// they would change if they were about twice as large (2^1.6 = 3) is taken off. Measured in the rooms of
/// docs/accuracy-and-speed.md; smooth light alone would want a third.
///
/// @tparam Real         float or double, of what is stored
/// @param direct        [n_cells, any number that divides n_columns] E0, unit free: column c starts with column
///                      c modulo their number
/// @param point_direct  [n_points, the same]
/// @param shine         null where every surface is diffusing
/// @throws Interrupted
template <class Real>
Gathered<Real> gather(const Network& network, const Cells& cells, const Columns<Real>& direct,
                      const Columns<Real>& point_direct, const Reflectances& reflectances,
                      const GatherOptions& options, const Job& job, const GatherShine* shine = nullptr);

/// What measuring points receive from cells whose irradiances are known: the last step of a solution.
/// [n_points, n_columns]
/// @param cell  [n_cells, n_columns] total irradiance; @param psi  [n_states, n_columns], empty without lobes
template <class Real>
Columns<Real> gather_points(const Network& network, const Cells& cells, const Columns<Real>& cell,
                            const std::vector<float>& psi, const Columns<Real>& point_direct,
                            const Reflectances& reflectances, const GatherShine* shine);

}  // namespace dim
