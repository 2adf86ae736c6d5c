#pragma once

#include <vector>

#include "transport/columns.hpp"
#include "transport/direct.hpp"
#include "transport/gather.hpp"
#include "transport/solution.hpp"

namespace dim {

/// Rows [source, class, i] as they are stored, of the first `n_rows` of a solver's columns
/// class * n_sources + source. What ended below zero by rounding is zero.
std::vector<float> rows_of_columns(const Columns<float>& columns, std::size_t n_rows, std::size_t n_sources);

/// The same of light by direction, from flux per area into each patch to its mean per solid angle.
std::vector<float> rows_of_states(const std::vector<float>& columns, const PatchGrid& grid,
                                  std::size_t n_sources, std::size_t n_columns);

/// Fills the energy balance and the convergence figures of `solution.sources` from the ends of the columns.
/// @param flights        [n_sources]
/// @param class_flux_lm  [n_sources] flux of sources that send another in each class [n_classes]; else empty
void add_energy(Solution& solution, const std::vector<ColumnReport>& columns,
                const std::vector<FirstFlight>& flights, const std::vector<std::vector<double>>& class_flux_lm);

/// @throws InputError  naming the first source whose light is beyond what single precision holds
void check_storable(const Solution& solution);

}  // namespace dim
