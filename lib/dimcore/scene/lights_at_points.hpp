#pragma once

#include "base/error.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Warns of luminaires whose luminous opening holds a measuring point: its direct light there has no value, and is
/// left out. One line, with the first of each.
Warnings warn_of_lights_at_points(const Zone& zone, const Lights& lights);

}  // namespace dim
