#pragma once

#include <span>
#include <vector>

#include "transport/direct.hpp"
#include "transport/gather.hpp"
#include "transport/solution.hpp"

namespace dim {

/// Rows [source, class, i] in the precision stored from a solver's columns [i, class * n_sources + source].
/// What ended below zero by rounding is zero.
/// @param n_columns  n_sources times the number of classes that the columns have
std::vector<float> rows_of_columns(std::span<const double> columns, std::size_t n_sources,
                                   std::size_t n_columns);

/// The same of light by direction, from flux per area into each patch to its mean per solid angle.
std::vector<float> rows_of_states(const std::vector<float>& columns, const PatchGrid& grid,
                                  std::size_t n_sources, std::size_t n_columns);

/// Fills the energy balance and the convergence figures of `solution.sources` from the ends of the columns.
/// @param flights  [n_sources]
void add_energy(Solution& solution, const std::vector<ColumnReport>& columns,
                const std::vector<FirstFlight>& flights);

/// @throws InputError  naming the first source whose light is beyond what single precision holds
void check_storable(const Solution& solution);

}  // namespace dim
