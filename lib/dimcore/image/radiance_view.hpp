#pragma once

#include <string>

#include "scene/view.hpp"

namespace dim {

/// What follows VIEW= in a Radiance picture of a view, in the zone file's axes, m:
/// "-vtv -vp 0.3 0.3 1.6 -vd 0.83 0.53 -0.2 -vu 0 0 1 -vh 70 -vv 55". Its type is -vtv for a perspective, -vtl for a
/// plan and an elevation (-vh and -vv are metres there), -vta for a fisheye, -vth for a hemispherical view.
/// @param origin_m  of the zone, see Zone
std::string radiance_view(const View& view, const Vec3& origin_m);

}  // namespace dim
