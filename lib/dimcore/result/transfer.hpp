#pragma once

#include <vector>

#include "transport/solution.hpp"

namespace dim {

/// The parts of a solution's light. What each holds: `Solution`.
enum class TransferPart {
  cell_direct,
  cell_total,
  point_direct,
  point_total,
  lobe_direct,
  lobe_total,
  point_cells,
  point_rays,
  point_cell_rays,
  point_direct_deviation,
  surface_cells,
  surface_rays,
  surface_direct_deviation
};
inline constexpr TransferPart kTransferParts[] = {
    TransferPart::cell_direct, TransferPart::cell_total,  TransferPart::point_direct,
    TransferPart::point_total, TransferPart::lobe_direct, TransferPart::lobe_total,
    TransferPart::point_cells, TransferPart::point_rays,  TransferPart::point_cell_rays,
    TransferPart::point_direct_deviation,
    TransferPart::surface_cells, TransferPart::surface_rays, TransferPart::surface_direct_deviation};

/// Where the light of a luminance database is kept: it may be larger than memory, so it is asked for source
/// by source.
class TransferStore {
 public:
  virtual ~TransferStore() = default;
  /// [n_classes, n_cells] and so on; direct light of cells and points [n_direct_classes, …]. Empty where the solution
  /// has none.
  virtual std::vector<float> of_source(TransferPart part, std::size_t source) const = 0;
};

/// A part of a solution in memory. [n_sources, …]
const std::vector<float>& part_of(const Solution& solution, TransferPart part);

}  // namespace dim
