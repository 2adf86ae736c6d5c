#include "network/cells.hpp"

namespace dim {

Cells::Cells(const Zone& zone) {
  grids_.reserve(zone.surfaces.size());
  first_.push_back(0);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto& surface = zone.surfaces[s];
    grids_.emplace_back(surface.polygon, surface.cell_m, surface.grid);
    const std::size_t n = surface.outside ? 0 : grids_.back().cells().size();
    first_.push_back(first_.back() + n);
    surface_of_.insert(surface_of_.end(), n, static_cast<std::uint32_t>(s));
  }
}

std::vector<Plate> plates_of(const Zone& zone) {
  std::vector<Plate> plates;
  plates.reserve(zone.surfaces.size());
  for (const auto& surface : zone.surfaces)
    plates.push_back({&surface.polygon, surface.twin >= 0, surface.fills_rectangle});
  return plates;
}

}  // namespace dim
