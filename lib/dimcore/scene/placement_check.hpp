#pragma once

#include <vector>

#include "base/error.hpp"
#include "scene/shell_cut.hpp"
#include "scene/surface_cut.hpp"
#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

/// What lies where it hardly can have been meant. All of it is warned of.
namespace dim {

/// Warns of a zone of a size that no room has (below 0.3 m, above 1.5 km, or 100 m in its smallest extent),
/// with the unit that would make a room of it.
void warn_of_size(const Zone& zone, const Place& place, Warnings& warnings);

/// Warns of boxes and two-sided panels that lie outside the zone or go through its bounding surfaces, and of
/// views whose eye lies outside or inside a box or furniture. Sheets and boxes that only touch are good.
/// The zone's surfaces are whole still: no feature cut out, no contact taken away.
/// @param links    one for each surface
/// @param eyes     places of the views' eyes, one for each view
/// @param touch_m  distance within which faces touch
/// @returns where bodies that go through the shell are to be cut off
std::vector<ShellCut> warn_of_placement(const Zone& zone, const std::vector<SurfaceLink>& links,
                                        const std::vector<Place>& eyes, const ZoneFrame& frame, double touch_m,
                                        Warnings& warnings);

}  // namespace dim
