#include "network/cells.hpp"

#include "scene/joints.hpp"

namespace dim {

// The ray caster takes what is nearer than 1e-9 of the zone for one. Cells are ten times as wide at least, so
// that rays can start in each farther than that from a wall at its edge; hits are judged as far before the
// end.
namespace {
constexpr double kNarrow = 1e-8;
}  // namespace

Cells::Cells(const Zone& zone) : first_{0}, back_m_(kNarrow * zone.diameter_m) {
  add_surfaces_from(0, zone, find_joints(zone));
}

Cells::Cells(const Cells& cells, const Zone& zone) : Cells(cells) {
  add_surfaces_from(n_surfaces(), zone, std::vector<std::vector<Segment2>>(zone.surfaces.size()));
}

void Cells::add_surfaces_from(std::size_t first, const Zone& zone,
                              const std::vector<std::vector<Segment2>>& joints) {
  grids_.reserve(zone.surfaces.size());
  for (std::size_t s = first; s < zone.surfaces.size(); ++s) {
    const auto& surface = zone.surfaces[s];
    grids_.emplace_back(surface.polygon, surface.cell_m, surface.grid, joints[s], kNarrow * zone.diameter_m);
    axes_.push_back({surface.polygon.frame().u, surface.polygon.frame().v});
    const std::size_t n = surface.outside ? 0 : grids_.back().cells().size();
    first_.push_back(first_.back() + n);
    surface_of_.insert(surface_of_.end(), n, static_cast<std::uint32_t>(s));
  }
}

void Cells::leave_free(std::size_t cell, AreaSampler free) {
  free_share_.resize(size(), 1.0);
  free_share_[cell] = free.area() / (*this)[cell].area_m2;
  free_parts_.insert_or_assign(cell, std::move(free));
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
