#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dim {

/// Loops over all cells with sums and maxima for each column of a block: cells in runs of fixed length, the
/// runs in order, so that any number of threads gives the same bits.
class CellSums {
 public:
  /// @param width  columns of the block
  CellSums(std::size_t n_cells, std::size_t width) : n_cells_(n_cells), width_(width) {}

  /// Calls f(first, last) for every run of cells.
  template <class F>
  void runs(F&& f) const {
    tbb::parallel_for(std::size_t{0}, n_runs(), [&](std::size_t run) {
      f(run * kRun, std::min(n_cells_, (run + 1) * kRun));
    });
  }
  /// Calls f(cell).
  template <class F>
  void each(F&& f) const {
    runs([&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) f(i);
    });
  }

  /// Calls f(first, last, sums) for every run of cells, which adds its terms to sums, zero before.
  /// @tparam Real  what a run's terms are added in; runs are added in double
  /// @returns [n_sums, width]
  template <class Real, class F>
  std::vector<double> add(std::size_t n_sums, F&& f) const {
    return joined<Real>(n_sums, f, [](double a, double b) { return a + b; });
  }
  /// The same for maxima of terms >= 0.
  template <class Real, class F>
  std::vector<double> largest(std::size_t n_sums, F&& f) const {
    return joined<Real>(n_sums, f, [](double a, double b) { return std::max(a, b); });
  }

 private:
  static constexpr std::size_t kRun = 64;
  std::size_t n_runs() const { return (n_cells_ + kRun - 1) / kRun; }

  template <class Real, class F, class Join>
  std::vector<double> joined(std::size_t n_sums, F&& f, Join&& join) const {
    const std::size_t n = n_sums * width_;
    std::vector<Real> of_run(n_runs() * n, Real{0});
    runs([&](std::size_t first, std::size_t last) { f(first, last, &of_run[first / kRun * n]); });
    std::vector<double> total(n, 0.0);
    for (std::size_t run = 0; run < n_runs(); ++run) {
      for (std::size_t s = 0; s < n; ++s) total[s] = join(total[s], static_cast<double>(of_run[run * n + s]));
    }
    return total;
  }

  std::size_t n_cells_, width_;
};

}  // namespace dim
