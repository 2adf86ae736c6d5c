#pragma once

#include "scene/zone.hpp"

namespace dim {

/// Whether any corner of the zone's surfaces lies behind the plane of a frame by more than the tolerance.
bool any_corner_behind(const Zone& zone, const Frame& frame, double tolerance_m);

}  // namespace dim
