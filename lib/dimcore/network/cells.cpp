#include "network/cells.hpp"

#include "scene/joints.hpp"

namespace dim {

// The ray caster takes what is nearer than 1e-9 of the zone for one. Cells are ten times as wide at least, so
// that rays can start in each farther than that from a wall at its edge; hits are judged as far before the
// end.
Cells::Cells(const Zone& zone) {
  constexpr double kNarrow = 1e-8;
  back_m_ = kNarrow * zone.diameter_m;
  const auto joints = find_joints(zone);
  grids_.reserve(zone.surfaces.size());
  first_.push_back(0);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto& surface = zone.surfaces[s];
    grids_.emplace_back(surface.polygon, surface.cell_m, surface.grid, joints[s], kNarrow * zone.diameter_m);
    axes_.push_back({surface.polygon.frame().u, surface.polygon.frame().v});
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
