#pragma once

#include <vector>

#include "geometry/segment.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Where other surfaces touch or cross a surface's polygon on its lit side: the foot of a wall or panel, the
/// line where something passes through. In the polygon's local frame, cut to its bounding rectangle; lines
/// along that rectangle's own sides are left out. Things count as touching within the tolerance of
/// surface_cut.
///
/// What lies in one plane touches along outlines, which cells follow anyway; both sides of a panel touch in
/// the same lines, and one of them stands for both; external obstructions neither touch nor are touched.
/// @returns [n_surfaces]
std::vector<std::vector<Segment2>> find_joints(const Zone& zone);

}  // namespace dim
