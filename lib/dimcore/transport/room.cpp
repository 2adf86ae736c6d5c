#include "transport/room.hpp"

namespace dim {

Room::Room(const Zone& zone_in, const Cells& cells_in, const Network& network_in, const Lights& lights_in,
           const Job& job)
    : bodied_(add_bodies(zone_in, cells_in, network_in, lights_in, job)),
      zone(bodied_ ? bodied_->zone : zone_in),
      cells(bodied_ ? bodied_->cells : cells_in),
      network(bodied_ ? bodied_->network : network_in),
      lights(bodied_ ? bodied_->lights : lights_in),
      obstructions(zone, lights),
      n_zone_cells(cells_in.size()),
      n_zone_surfaces(zone_in.surfaces.size()),
      n_bodies(bodied_ ? bodied_->n_bodies : 0) {}

}  // namespace dim
