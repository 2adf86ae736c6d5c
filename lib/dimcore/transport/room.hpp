#pragma once

#include <optional>

#include "light/obstructions.hpp"
#include "network/with_bodies.hpp"

namespace dim {

/// What light meets and where it comes from: made once, then handed on. Bodies of luminaires stand among the
/// zone's surfaces, with cells and rays of their own (`add_bodies`).
class Room {
 public:
  /// The zone, its cells and network must outlive the room, the lights as well.
  /// @throws LimitError, Interrupted  see `add_bodies`
  Room(const Zone& zone_in, const Cells& cells_in, const Network& network_in, const Lights& lights_in,
       const Job& job);
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

 private:
  const std::optional<BodiedRoom> bodied_;  // what the references below point into, where there are bodies

 public:
  const Zone& zone;
  const Cells& cells;
  const Network& network;
  const Lights& lights;
  const Obstructions obstructions;
  const std::size_t n_zone_cells;  ///< cells of the zone itself: the first ones
  const std::size_t n_zone_surfaces;  ///< and its surfaces
  const std::size_t n_bodies;

  std::size_t n_points() const { return zone.points.size(); }
  std::size_t n_luminaires() const { return lights.luminaires.size(); }
  const Surface& surface_of(std::size_t cell) const { return zone.surfaces[cells.surface_of(cell)]; }
};

}  // namespace dim
