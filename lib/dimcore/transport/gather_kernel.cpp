#include "transport/gather_kernel.hpp"

#include <cstring>

#include "base/error.hpp"
#include "base/target_clones.hpp"

namespace dim {
namespace {

template <std::size_t kLanes, class Sink, class Real>
DIM_INLINE void gather_one(const Sink* sinks, const PatchGrid& patches, const Real* exitance, double* sums) {
  Lane<double> total[kLanes] = {};
  for (int slice = 0; slice < patches.n_slices; ++slice) {
    Lane<Real> in_slice[kLanes] = {};
    for (int sector = 0; sector < patches.n_sectors; ++sector) {
      const auto* from =
          reinterpret_cast<const Lane<Real>*>(exitance + *sinks++ * (kLanes * kColumnsPerLane));
      for (std::size_t lane = 0; lane < kLanes; ++lane) in_slice[lane] += from[lane];
    }
    const double weight = patches.weight_sr(slice) / kPi;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      total[lane] += __builtin_convertvector(in_slice[lane], Lane<double>) * weight;
  }
  std::memcpy(sums, total, sizeof total);
}

template <class Sink, class Real>
DIM_INLINE void gather_block(const Sink* sinks, const PatchGrid& patches, const Real* exitance,
                             std::size_t n_columns, std::size_t n_rows, double* sums) {
  const std::size_t n_patches = patches.n_patches();
  for (std::size_t row = 0; row < n_rows; ++row, sinks += n_patches, sums += n_columns) {
    switch (n_columns / kColumnsPerLane) {
      case 1:
        gather_one<1>(sinks, patches, exitance, sums);
        break;
      case 2:
        gather_one<2>(sinks, patches, exitance, sums);
        break;
      case 3:
        gather_one<3>(sinks, patches, exitance, sums);
        break;
      default:
        gather_one<4>(sinks, patches, exitance, sums);
        break;
    }
  }
}

// Four functions, because a template cannot be cloned.
DIM_TARGET_CLONES void gather_as(const std::uint16_t* sinks, const PatchGrid& patches, const double* exitance,
                                 std::size_t n_columns, std::size_t n_rows, double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}
DIM_TARGET_CLONES void gather_as(const std::uint32_t* sinks, const PatchGrid& patches, const double* exitance,
                                 std::size_t n_columns, std::size_t n_rows, double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}
DIM_TARGET_CLONES void gather_as(const std::uint16_t* sinks, const PatchGrid& patches, const float* exitance,
                                 std::size_t n_columns, std::size_t n_rows, double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}
DIM_TARGET_CLONES void gather_as(const std::uint32_t* sinks, const PatchGrid& patches, const float* exitance,
                                 std::size_t n_columns, std::size_t n_rows, double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}

template <class Real>
void add_extra(const ExtraLinks& extra, const Real* exitance, std::size_t n_columns, std::size_t row,
               double* sums) {
  for (auto e = extra.first[row]; e < extra.first[row + 1]; ++e) {
    const Real* from = exitance + extra.cell[e] * n_columns;
    for (std::size_t c = 0; c < n_columns; ++c) sums[c] += extra.weight[e] * static_cast<double>(from[c]);
  }
}

}  // namespace

template <class Real>
void gather_rows(const SinkTable& sinks, const PatchGrid& patches, const ExtraLinks* extra,
                 const Real* exitance, std::size_t n_columns, std::size_t first_row, std::size_t last_row,
                 double* sums) {
  if (n_columns % kColumnsPerLane != 0 || n_columns > kMaxColumns)
    throw InternalError("gathering " + std::to_string(n_columns) + " columns at once");
  const std::size_t skipped = first_row * patches.n_patches(), n_rows = last_row - first_row;
  sinks.visit([&](const auto* entries) {
    gather_as(entries + skipped, patches, exitance, n_columns, n_rows, sums);
  });
  if (!extra || extra->first.empty()) return;
  for (std::size_t row = first_row; row < last_row; ++row)
    add_extra(*extra, exitance, n_columns, row, sums + (row - first_row) * n_columns);
}

template void gather_rows(const SinkTable&, const PatchGrid&, const ExtraLinks*, const double*, std::size_t,
                          std::size_t, std::size_t, double*);
template void gather_rows(const SinkTable&, const PatchGrid&, const ExtraLinks*, const float*, std::size_t,
                          std::size_t, std::size_t, double*);

}  // namespace dim
