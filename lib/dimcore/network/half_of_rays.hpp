#pragma once

#include "hemisphere/patches.hpp"
#include "network/sink_table.hpp"

namespace dim {

/// The patches that are left of a grid with every other sector.
inline PatchGrid half_of(const PatchGrid& grid) { return {grid.n_slices, (grid.n_sectors + 1) / 2}; }

/// Every other ray, by sector, of the rows [first, last): a coarser sampling of the same hemispheres, whose difference
/// from all rays tells how far these may be off. Of an odd number of sectors two neighbours are among them; where they
/// are goes round from slice to slice.
/// @param grid  of the sinks' patches
inline SinkTable half_of_rays(const SinkTable& sinks, const PatchGrid& grid, std::size_t n_cells, std::size_t first,
                              std::size_t last) {
  SinkTable half(last - first, half_of(grid).n_patches(), n_cells);
  const auto n_sectors = static_cast<std::size_t>(grid.n_sectors);
  for (std::size_t row = first; row < last; ++row) {
    std::size_t to = 0;
    for (std::size_t from = 0; from < grid.n_patches(); from += n_sectors) {
      const std::size_t start = n_sectors % 2 == 0 ? 0 : from / static_cast<std::size_t>(grid.n_slices);
      for (std::size_t sector = 0; sector < n_sectors; sector += 2)
        half.set(row - first, to++, sinks.at(row, from + (start + sector) % n_sectors));
    }
  }
  return half;
}

}  // namespace dim
