#pragma once

#include <vector>

#include "network/network.hpp"

namespace dim {

/// Sets the network's visible shares and its row and column scales so that energy is kept and a uniform
/// enclosure stays uniform.
///
/// Sampled rows add up to the visible share of the hemisphere but need not be reciprocal: what cell j sends,
/// sum_i A_i F_ij, differs by the sampling error from the A_j V_j that reciprocity asks (V_j: the share of
/// j's own hemisphere that ends on cells). Rows and columns are scaled in turn (Sinkhorn & Knopp 1967) until
///   sum_j r_i F_ij c_j = V_i   and   sum_i A_i r_i F_ij c_j = A_j V_j.
/// The scales cost nothing in the solution. `network.imbalance` is the sum of the columns' deviations over
/// the sum of their dues, before the last round. Rounds end at 3e-4, or at 8: it starts at some 3e-2, and
/// what is left then is cells that hardly see the rest of the zone (a gap behind a cabinet), which settle
/// slowly and matter little.
void balance(Network& network, const Cells& cells);

/// One column through the plain network: result_i = sum_j F_ij x_j, without scales. @param x [n_cells]
std::vector<double> apply_rows(const Network& network, const std::vector<double>& x);

/// The transposed: result_j = sum_i y_i F_ij. The same bits on any number of threads. @param y [n_cells]
std::vector<double> apply_columns(const Network& network, const std::vector<double>& y);

}  // namespace dim
