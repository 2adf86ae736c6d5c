#pragma once

#include <cstdint>
#include <vector>

#include "reflection/lobe.hpp"

namespace dim {

/// Applies a lobe on patches to many columns of light at once.
///
/// A lobe turns with the light, so that for each pair of slices it is a circular convolution over the
/// sectors: with light stored [patch, column], sector and column are one index in memory, and turning is
/// moving along it. SIMD runs along that index, in the same order of sums whatever the machine's width.
class LobeKernel {
 public:
  explicit LobeKernel(const LobeMatrix& lobe, const PatchGrid& grid);

  /// Doubles that `apply` needs to work in.
  std::size_t n_scratch(std::size_t n_columns) const;

  /// out[patch, c] = sum over patches in of share(in -> patch) * in[in, c].
  /// @param in, out  [n_patches] rows of n_columns, `stride` apart
  /// @param scratch  [n_scratch(n_columns)]
  void apply(const double* in, double* out, std::size_t n_columns, std::size_t stride, double* scratch) const;

 private:
  std::size_t n_slices_, n_sectors_;
  std::vector<std::size_t> first_;     // [n_slices + 1] entries of each slice out
  std::vector<std::uint32_t> offset_;  // of what an entry reads, in rows of columns
  std::vector<double> share_;
};

}  // namespace dim
