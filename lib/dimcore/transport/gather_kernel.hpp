#pragma once

#include <cstddef>
#include <vector>

#include "network/network.hpp"
#include "transport/lanes.hpp"

namespace dim {

/// Columns gathered in one pass over the sinks.
inline constexpr std::size_t kMaxColumns = 32;

/// sums[row - first_row, c] = sum over patches of w_k/pi * exitance[sink(row, k), c] for rows [first_row, last_row),
/// extra links included where `extra` is given.
///
/// @param exitance  [n_cells + 1, n_columns] of float or double, the last row zero (rays that end nowhere read
///                  it). Sectors of a slice are added in that precision, slices in double.
/// @param n_columns multiple of 8, at most kMaxColumns
/// @param sums      [last_row - first_row, n_columns], written
template <class Real>
void gather_rows(const SinkTable& sinks, const PatchGrid& patches, const ExtraLinks* extra,
                 const Real* exitance, std::size_t n_columns, std::size_t first_row, std::size_t last_row,
                 double* sums);

}  // namespace dim
