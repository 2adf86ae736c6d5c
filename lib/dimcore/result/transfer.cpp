#include "result/transfer.hpp"

#include "base/error.hpp"

namespace dim {

const std::vector<float>& part_of(const Solution& solution, TransferPart part) {
  switch (part) {
    case TransferPart::cell_direct:
      return solution.cell_direct;
    case TransferPart::cell_total:
      return solution.cell_total;
    case TransferPart::point_direct:
      return solution.point_direct;
    case TransferPart::point_total:
      return solution.point_total;
    case TransferPart::lobe_direct:
      return solution.directional.direct;
    case TransferPart::lobe_total:
      return solution.directional.total;
    case TransferPart::point_cells:
      return solution.point_cells;
    case TransferPart::point_rays:
      return solution.point_rays;
    case TransferPart::point_cell_rays:
      return solution.point_cell_rays;
    case TransferPart::point_direct_deviation:
      return solution.point_direct_deviation;
    case TransferPart::surface_cells:
      return solution.surface_cells;
    case TransferPart::surface_rays:
      return solution.surface_rays;
    case TransferPart::surface_direct_deviation:
      return solution.surface_direct_deviation;
  }
  throw InternalError("part of a solution of no name");
}

}  // namespace dim
