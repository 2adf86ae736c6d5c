#pragma once

#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

namespace dim {

class TomlTable;

/// Reads [[plane]], [[area]], [[sensors]], [[view]] and [site] into the zone, with the points of planes laid out.
/// @param cell_m  spacing of planes that state neither `spacing` nor `grid`
void read_receivers(const TomlTable& root, const ZoneFrame& frame, double cell_m, Zone& zone);

}  // namespace dim
