#pragma once

#include <cstdint>

#include "network/cells.hpp"

namespace dim {

/// What the end of a ray means for a network.
struct Landing {
  std::uint32_t sink = 0;  ///< cell, or the number of cells where the ray ends on none
  bool escaped = false;    ///< into the open, or on an external obstruction
  bool back = false;       ///< on the back of a surface
  int surface = -1;        ///< that it met
};

/// @param hit  of a caster of the zone's plates
inline Landing landing_of(const Hit& hit, const Vec3& direction, const Zone& zone, const Cells& cells) {
  const auto nothing = static_cast<std::uint32_t>(cells.size());
  if (hit.plate < 0) return {nothing, true, false, -1};
  const auto surface = static_cast<std::size_t>(hit.plate);
  if (hit.back) return {nothing, false, true, hit.plate};
  if (zone.surfaces[surface].outside) return {nothing, true, false, hit.plate};
  return {static_cast<std::uint32_t>(cells.cell_hit(surface, hit.local, direction)), false, false,
          hit.plate};
}

}  // namespace dim
