#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "network/cells.hpp"

namespace dim {

/// What one more smoothing does to light that cells hold.
///
/// Cells hold means and hand them on as constants: each smooths the light over a cell, and both together bring
/// too little of it from where it is bright to what lies near. Smoothed once more over twice the cells' size, by
/// 1/4, 1/2, 1/4 along both axes of a surface's squares, the light tells by how much. Cells exchange with the
/// four next to them, where neither an edge nor a joint stands between, neither is covered by a body, and as far as
/// the smaller one reaches, so that flux is kept.
class CellSmoothing {
 public:
  explicit CellSmoothing(const Cells& cells);

  /// Smoothed values less the values themselves. [n_cells, width]
  /// @param change  written; not `values`
  void change(const std::vector<double>& values, std::size_t width, std::vector<double>& change) const;

 private:
  struct Neighbour {
    std::uint32_t cell;
    double share;  // of its value that is taken over, of the own one that is given up
  };
  std::vector<std::size_t> first_;  // [n_cells + 1]
  std::vector<Neighbour> neighbours_;
};

}  // namespace dim
