#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "geometry/area_sampler.hpp"
#include "geometry/cell_grid.hpp"
#include "geometry/ray_caster.hpp"
#include "scene/zone.hpp"

namespace dim {

/// The finite elements of a zone, surface after surface. Made from the zone alone, so that every program that
/// holds the zone has the same cells under the same numbers. They end where other surfaces touch or cross
/// theirs (see `find_joints`): no cell reaches both sides of a wall.
class Cells {
 public:
  Cells() = default;
  /// External obstructions get no cells.
  explicit Cells(const Zone& zone);

  /// The given cells under their own numbers, then those of the surfaces that `zone` has beyond the ones they
  /// were made of.
  Cells(const Cells& cells, const Zone& zone);

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
  /// What gives and takes light: the free part of cells that something lies on.
  double area_m2(std::size_t cell) const { return (*this)[cell].area_m2 * free_share(cell); }

  /// States that only `free`, some part of the cell in its surface's local frame, is not covered by something
  /// that lies on it. The cell keeps its outline.
  void leave_free(std::size_t cell, AreaSampler free);
  /// States that all of the cell is covered: no light reaches it or leaves it, whatever its area.
  void cover(std::size_t cell) { free_parts_.insert_or_assign(cell, AreaSampler()); }
  bool covered(std::size_t cell) const {
    const auto found = free_parts_.find(cell);
    return found != free_parts_.end() && !(found->second.area() > 0.0);
  }
  /// Share of the cell, (0, 1], that nothing lies on; 1 where it is covered.
  double free_share(std::size_t cell) const { return free_share_.empty() ? 1.0 : free_share_[cell]; }
  /// That part, null where it is the whole cell or nothing.
  const AreaSampler* free_part(std::size_t cell) const {
    const auto found = free_parts_.find(cell);
    return found == free_parts_.end() || !(found->second.area() > 0.0) ? nullptr : &found->second;
  }
  /// Corners of the convex cell, counter-clockwise, in its surface's local frame.
  void outline(std::size_t cell, Ring2& corners) const {
    const std::size_t surface = surface_of_[cell];
    grids_[surface].outline(cell - first_[surface], corners);
  }

  /// The cell on which a ray ends. Within rounding of a joint that is the one on the side it comes from.
  /// @param local      where it meets the surface
  /// @param direction  of the ray, in space, unit
  std::size_t cell_hit(std::size_t surface, const Vec2& local, const Vec3& direction) const {
    const CellGrid& grid = grids_[surface];
    return first_[surface] + static_cast<std::size_t>(grid.cell_at(
                                 grid.regular() ? local : moved_back(surface, local, direction)));
  }

 private:
  struct Axes {
    Vec3 u, v;
  };
  Vec2 moved_back(std::size_t surface, const Vec2& local, const Vec3& direction) const {
    const Vec2 along(glm::dot(axes_[surface].u, direction), glm::dot(axes_[surface].v, direction));
    const double length = glm::length(along);
    return length > 0.0 ? local - (back_m_ / length) * along : local;
  }
  void add_surfaces_from(std::size_t first, const Zone& zone,
                         const std::vector<std::vector<Segment2>>& joints);

  std::vector<CellGrid> grids_;
  std::vector<Axes> axes_;
  std::vector<std::size_t> first_;  // [n_surfaces + 1]
  std::vector<std::uint32_t> surface_of_;
  std::vector<double> free_share_;                // [size()], empty where nothing lies on any
  std::map<std::size_t, AreaSampler> free_parts_;
  double back_m_ = 0.0;
};

/// The surfaces as plates, plate index = surface index. They must outlive the plates' caster.
std::vector<Plate> plates_of(std::span<const Surface> surfaces);

/// The zone's surfaces as plates.
std::vector<Plate> plates_of(const Zone& zone);

}  // namespace dim
