#pragma once

#include <cstddef>
#include <vector>

#include "transport/cycle_kernel.hpp"
#include "transport/propagation.hpp"

namespace dim {

/// Conjugate residuals for x - K R x = b on all columns of a block, each with coefficients of its own, so that
/// no column depends on its companions. K: the network's rows and, unless there are lobes, mirrors.
///
/// In the inner product sum_i A_i rho_i x_i y_i the operator is self-adjoint but for the sampling error of
/// the network (reciprocity: A_i F_ij = A_j F_ji). Vinsome's Orthomin(1) makes every new direction conjugate
/// to the last by calculation rather than by symmetry, and takes the step that leaves the least residual: it
/// is the method of conjugate residuals where the operator is symmetric, and never makes the residual larger
/// where it is not (Eisenstat, Elman & Schultz 1983). Measured on office and corridor, 13 steps: no
/// difference to GMRES without restart, nor to conjugate gradients on symmetric links.
///
/// All in single precision, in units of the columns' first residuals: half the memory to read. What rounding
/// costs is in the next true residual.
class ConjugateResiduals {
 public:
  explicit ConjugateResiduals(Propagation& propagation);

  /// What one cycle is to reach, by column.
  struct Goal {
    bool active = false;  ///< false: x of this column stays as it is
    double local = 0.0;   ///< end when no reflecting cell's residual exceeds this share of its own x,
    double floor = 0.0;   ///< or of this, where x is less
    int most_sweeps = 0;
    int sweeps = 0;  ///< result
  };

  /// Adds to x what takes the residual away, until every column has reached its goal, its most sweeps, the end
  /// of what single precision tells or of what the method gains.
  void improve(std::vector<double>& x, const std::vector<double>& residual, std::vector<Goal>& goals);

 private:
  void start(const std::vector<double>& x, const std::vector<double>& residual, std::vector<Goal>& goals);
  std::vector<double> reduce();
  CycleRows rows(std::size_t first, std::size_t last);

  Propagation& propagation_;
  std::size_t width_;
  std::vector<float> rho_, area_m2_, row_scale_, column_scale_;
  std::vector<double> unit_;                                                     // [width] powers of two
  std::vector<float> floor_;                                                     // [width]
  std::vector<float> start_, change_, residual_, direction_, reduced_, reduced_residual_;  // [n_cells, width]
  std::vector<float> exitance_;                                                  // [n_cells + 1, width]
  std::vector<double> arriving_;  // where mirrors make it need more than a run of rows
};

}  // namespace dim
