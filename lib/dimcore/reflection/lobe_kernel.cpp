#include "reflection/lobe_kernel.hpp"

#include <algorithm>
#include <cstring>

#include "base/target_clones.hpp"

namespace dim {
namespace {

constexpr std::size_t kLane = 8;
using Lane = double __attribute__((vector_size(kLane * sizeof(double)), aligned(8)));

// The next kLanes lanes of one slice out.
template <std::size_t kLanes>
DIM_INLINE void sum_entries(const std::uint32_t* offset, const double* share, std::size_t n_entries,
                            const double* in, std::size_t n_columns, double* out) {
  Lane sum[kLanes] = {};
  for (std::size_t e = 0; e < n_entries; ++e) {
    const auto* from = reinterpret_cast<const Lane*>(in + offset[e] * n_columns);
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += from[lane] * share[e];
  }
  std::memcpy(out, sum, sizeof sum);
}

DIM_TARGET_CLONES void convolve(const std::uint32_t* offset, const double* share, std::size_t n_entries,
                                const double* in, std::size_t n_columns, std::size_t n, double* out) {
  std::size_t x = 0;
  for (; x + 3 * kLane < n; x += 4 * kLane)
    sum_entries<4>(offset, share, n_entries, in + x, n_columns, out + x);
  for (; x < n; x += kLane) sum_entries<1>(offset, share, n_entries, in + x, n_columns, out + x);
}

}  // namespace

// Every slice that comes in is laid out twice, one turn after the other, so that what is `turn` sectors back
// from any sector lies before it in memory.
LobeKernel::LobeKernel(const LobeMatrix& lobe, const PatchGrid& grid)
    : n_slices_(static_cast<std::size_t>(grid.n_slices)),
      n_sectors_(static_cast<std::size_t>(grid.n_sectors)) {
  first_.push_back(0);
  for (std::size_t out = 0; out < n_slices_; ++out) {
    for (std::size_t in = 0; in < n_slices_; ++in) {
      for (const auto* e = lobe.begin(static_cast<int>(in)); e != lobe.end(static_cast<int>(in)); ++e) {
        if (e->slice_out != out) continue;
        offset_.push_back(static_cast<std::uint32_t>(in * 2 * n_sectors_ + n_sectors_ - e->turn));
        share_.push_back(e->share);
      }
    }
    first_.push_back(offset_.size());
  }
}

std::size_t LobeKernel::n_scratch(std::size_t n_columns) const {
  return 3 * n_slices_ * n_sectors_ * n_columns + 2 * 4 * kLane;
}

void LobeKernel::apply(const double* in, double* out, std::size_t n_columns, std::size_t stride,
                       double* scratch) const {
  const std::size_t turn = n_sectors_ * n_columns;
  double* twice = scratch;
  double* sums = scratch + 2 * n_slices_ * turn + 4 * kLane;
  for (std::size_t slice = 0; slice < n_slices_; ++slice) {
    double* to = twice + slice * 2 * turn;
    for (std::size_t sector = 0; sector < n_sectors_; ++sector)
      std::copy_n(in + (slice * n_sectors_ + sector) * stride, n_columns, to + sector * n_columns);
    std::copy_n(to, turn, to + turn);
  }
  // Lanes run over the end of their slice, into what is written next or the room at the end.
  std::fill_n(twice + 2 * n_slices_ * turn, 4 * kLane, 0.0);
  for (std::size_t slice = 0; slice < n_slices_; ++slice)
    convolve(offset_.data() + first_[slice], share_.data() + first_[slice], first_[slice + 1] - first_[slice],
             twice, n_columns, turn, sums + slice * turn);
  for (std::size_t patch = 0; patch < n_slices_ * n_sectors_; ++patch)
    std::copy_n(sums + patch * n_columns, n_columns, out + patch * stride);
}

}  // namespace dim
