#pragma once

#include <cstddef>
#include <vector>

#include "network/network.hpp"

namespace dim {

/// Columns are gathered eight at a time, one SIMD operation for all eight, so that the order of every sum,
/// and so every bit, is the same whatever the machine's vector width.
inline constexpr std::size_t kColumnsPerLane = 8;
/// Columns gathered in one pass over the sinks.
inline constexpr std::size_t kMaxColumns = 32;

/// sums[row, c] = sum over patches of w_k/pi * exitance[sink(row, k), c] for rows [first_row, last_row),
/// extra links included where `extra` is given.
///
/// @param exitance  [n_cells + 1, n_columns], the last row zero (rays that end nowhere read it)
/// @param n_columns multiple of 8, at most kMaxColumns
/// @param sums      [n_rows, n_columns], written for the rows asked for
void gather_rows(const SinkTable& sinks, const PatchGrid& patches, const ExtraLinks* extra,
                 const double* exitance, std::size_t n_columns, std::size_t first_row, std::size_t last_row,
                 double* sums);

}  // namespace dim
