#pragma once

#include <vector>

#include "transport/contraction.hpp"
#include "transport/propagation.hpp"

namespace dim {

/// Irradiances below this share of their column's mean over lit cells are judged as if they were of that size.
inline constexpr double kIrradianceFloor = 1e-4;

/// How one column (a source in a reflectance class) ended. All power figures in the unit of direct
/// illuminance times square metres; received = absorbed + escaped + dropped + unbalanced, to rounding.
struct ColumnReport {
  int iterations = 0;     ///< reflections through the network
  double residual = 0.0;  ///< largest last change of a reflecting cell over its own irradiance, see options
  /// Bound of what is left out, over the column's mean irradiance of lit cells. Of the worst cell; with lobes
  /// of the mean over cells of absolute errors (see `Contraction`). Infinite where there is no bound.
  double error_bound = 0.0;
  double local_error_bound = 0.0;  ///< of the worst cell over its own irradiance; infinite with lobes
  double received = 0.0;           ///< direct, on cells
  double absorbed = 0.0;           ///< by cells
  double escaped = 0.0;            ///< reflected out of the zone or onto backs
  double dropped = 0.0;            ///< the last change's reflections, not followed; either sign
  double unbalanced = 0.0;         ///< lost by the network, whose columns and rows differ a little; either sign
  double cut = 0.0;                ///< what mirrors may have reflected beyond the last that was followed, at most
};

/// The last reflection of a block of columns, whose result is final.
struct LastReflection {
  const std::vector<double>& irradiance;  ///< [n_cells, width] result
  const std::vector<double>& change;      ///< [n_cells, width] from what was reflected to the result
  const std::vector<double>& lobes;       ///< [width] flux, sum of absolute changes of what lobes send
  const std::vector<double>& lost_m2;     ///< [n_cells] of what a cell sends at unit exitance, see `lost_by_cells`
};

/// Energy and bounds of each of the block's columns; `received`, `iterations` and `residual` are left to the
/// caller. [n_columns of the block]
/// @param classes  [n_columns of the block], for the contraction
std::vector<ColumnReport> report_columns(Propagation& propagation, const LastReflection& last,
                                         const Contraction& contraction,
                                         const std::vector<std::size_t>& classes);

/// By how much less arrives on cells than each sends to them at unit exitance, because the network's columns are
/// balanced to `Network::imbalance` only; either sign. [n_cells] m2
std::vector<double> lost_by_cells(const Network& network, const Cells& cells);

}  // namespace dim
