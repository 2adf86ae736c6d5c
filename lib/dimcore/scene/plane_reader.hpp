#pragma once

#include "scene/set_names.hpp"
#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

namespace dim {

/// Reads a [[plane]] and lays out its points.
/// @param cell_m  spacing where it states neither `spacing` nor `grid`
void read_plane(const TomlTable& table, const ZoneFrame& frame, double cell_m, SetNames& names, Zone& zone);

/// Reads an [[area]]: a level task area, and around it the planes of its immediate surrounding, `NAME.surrounding`, a
/// band at its own height, and of its background, `NAME.background`, a band around that on the floor; both where there
/// is a floor below, and not over the task. After EN 12464-1.
void read_area(const TomlTable& table, const ZoneFrame& frame, SetNames& names, Zone& zone);

}  // namespace dim
