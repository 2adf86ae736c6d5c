#include "transport/gather_kernel.hpp"

#include <cstring>

#include "base/error.hpp"
#include "base/target_clones.hpp"

namespace dim {
namespace {

using Lane = double __attribute__((vector_size(kColumnsPerLane * sizeof(double)), aligned(8)));

template <class Sink, std::size_t kLanes>
DIM_INLINE void gather_one(const Sink* sinks, const PatchGrid& patches, const double* exitance,
                           double* sums) {
  Lane total[kLanes] = {};
  for (int slice = 0; slice < patches.n_slices; ++slice) {
    Lane in_slice[kLanes] = {};
    for (int sector = 0; sector < patches.n_sectors; ++sector) {
      const auto* from = reinterpret_cast<const Lane*>(exitance + *sinks++ * (kLanes * kColumnsPerLane));
      for (std::size_t lane = 0; lane < kLanes; ++lane) in_slice[lane] += from[lane];
    }
    const double weight = patches.weight_sr(slice) / kPi;
    for (std::size_t lane = 0; lane < kLanes; ++lane) total[lane] += in_slice[lane] * weight;
  }
  std::memcpy(sums, total, sizeof total);
}

template <class Sink>
DIM_INLINE void gather_block(const Sink* sinks, const PatchGrid& patches, const double* exitance,
                             std::size_t n_columns, std::size_t n_rows, double* sums) {
  const std::size_t n_patches = patches.n_patches();
  for (std::size_t row = 0; row < n_rows; ++row, sinks += n_patches, sums += n_columns) {
    switch (n_columns / kColumnsPerLane) {
      case 1:
        gather_one<Sink, 1>(sinks, patches, exitance, sums);
        break;
      case 2:
        gather_one<Sink, 2>(sinks, patches, exitance, sums);
        break;
      case 3:
        gather_one<Sink, 3>(sinks, patches, exitance, sums);
        break;
      default:
        gather_one<Sink, 4>(sinks, patches, exitance, sums);
        break;
    }
  }
}

DIM_TARGET_CLONES void gather_narrow(const std::uint16_t* sinks, const PatchGrid& patches,
                                     const double* exitance, std::size_t n_columns, std::size_t n_rows,
                                     double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}

DIM_TARGET_CLONES void gather_wide(const std::uint32_t* sinks, const PatchGrid& patches,
                                   const double* exitance, std::size_t n_columns, std::size_t n_rows,
                                   double* sums) {
  gather_block(sinks, patches, exitance, n_columns, n_rows, sums);
}

void add_extra(const ExtraLinks& extra, const double* exitance, std::size_t n_columns, std::size_t row,
               double* sums) {
  for (auto e = extra.first[row]; e < extra.first[row + 1]; ++e) {
    const double* from = exitance + extra.cell[e] * n_columns;
    for (std::size_t c = 0; c < n_columns; ++c) sums[c] += extra.weight[e] * from[c];
  }
}

}  // namespace

void gather_rows(const SinkTable& sinks, const PatchGrid& patches, const ExtraLinks* extra,
                 const double* exitance, std::size_t n_columns, std::size_t first_row, std::size_t last_row,
                 double* sums) {
  if (n_columns % kColumnsPerLane != 0 || n_columns > kMaxColumns)
    throw InternalError("gathering " + std::to_string(n_columns) + " columns at once");
  const std::size_t skipped = first_row * patches.n_patches(), n_rows = last_row - first_row;
  double* out = sums + first_row * n_columns;
  if (sinks.wide())
    gather_wide(sinks.wide_entries().data() + skipped, patches, exitance, n_columns, n_rows, out);
  else
    gather_narrow(sinks.narrow().data() + skipped, patches, exitance, n_columns, n_rows, out);
  if (!extra || extra->first.empty()) return;
  for (std::size_t row = first_row; row < last_row; ++row)
    add_extra(*extra, exitance, n_columns, row, sums + row * n_columns);
}

}  // namespace dim
