#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cell_grid.hpp"
#include "geometry/ray_caster.hpp"
#include "scene/zone.hpp"

namespace dim {

/// The finite elements of a zone, surface after surface. Made from the zone alone, so that every program that
/// holds the zone has the same cells under the same numbers.
class Cells {
 public:
  Cells() = default;
  /// External obstructions get no cells.
  explicit Cells(const Zone& zone);

  std::size_t size() const { return surface_of_.size(); }
  std::size_t n_surfaces() const { return grids_.size(); }
  /// Cells of surface s are [first(s), first(s + 1)).
  std::size_t first(std::size_t surface) const { return first_[surface]; }
  std::size_t surface_of(std::size_t cell) const { return surface_of_[cell]; }
  const CellGrid& grid(std::size_t surface) const { return grids_[surface]; }
  const GridCell& operator[](std::size_t cell) const {
    const std::size_t surface = surface_of_[cell];
    return grids_[surface].cells()[cell - first_[surface]];
  }
  double area_m2(std::size_t cell) const { return (*this)[cell].area_m2; }

 private:
  std::vector<CellGrid> grids_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> surface_of_;
};

/// The zone's surfaces as plates, plate index = surface index.
std::vector<Plate> plates_of(const Zone& zone);

}  // namespace dim
