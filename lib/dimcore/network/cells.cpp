#include "network/cells.hpp"

namespace dim {

Cells::Cells(const Zone& zone) : first_{0} { add_surfaces_from(0, zone); }

Cells::Cells(const Cells& cells, const Zone& zone) : Cells(cells) { add_surfaces_from(n_surfaces(), zone); }

void Cells::add_surfaces_from(std::size_t first, const Zone& zone) {
  grids_.reserve(zone.surfaces.size());
  for (std::size_t s = first; s < zone.surfaces.size(); ++s) {
    const auto& surface = zone.surfaces[s];
    grids_.emplace_back(surface.polygon, surface.cell_m, surface.grid);
    const std::size_t n = surface.outside ? 0 : grids_.back().cells().size();
    first_.push_back(first_.back() + n);
    surface_of_.insert(surface_of_.end(), n, static_cast<std::uint32_t>(s));
  }
}

std::vector<Plate> plates_of(std::span<const Surface> surfaces) {
  std::vector<Plate> plates;
  plates.reserve(surfaces.size());
  for (const auto& surface : surfaces)
    plates.push_back({&surface.polygon, surface.twin >= 0, surface.fills_rectangle});
  return plates;
}

std::vector<Plate> plates_of(const Zone& zone) { return plates_of(std::span(zone.surfaces)); }

}  // namespace dim
