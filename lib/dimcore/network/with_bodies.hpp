#pragma once

#include <optional>

#include "base/job.hpp"
#include "network/network.hpp"
#include "scene/lights.hpp"

namespace dim {

/// A zone in which the bodies of luminaires are ordinary surfaces with cells and rays of their own, so that
/// nothing that follows need know of them.
struct BodiedRoom {
  Zone zone;        ///< surfaces and finishes of bodies after the zone's own
  Cells cells;      ///< cells of bodies after the zone's own
  Network network;
  Lights lights;    ///< without bodies: they stand in the zone
  std::size_t n_zone_cells = 0;
  std::size_t n_bodies = 0;
};

/// Puts the luminaires' bodies into a zone's network; nothing where no luminaire has one.
///
/// The rays are those that `build_network` casts for the zone with bodies, sink by sink, but only rows and
/// patches whose cone meets a body are looked at again; rows of the bodies' own cells are traced. The bodies'
/// cells are as large as the zone's are on the average. A body that lies on a surface does not split its
/// cells: they keep their free part (see `leave_free_of_bodies`), from which their rays start.
/// @throws LimitError   when the second copy of the network does not fit job.memory_limit_bytes
/// @throws Interrupted
std::optional<BodiedRoom> add_bodies(const Zone& zone, const Cells& cells, const Network& network,
                                     const Lights& lights, const Job& job);

}  // namespace dim
