#pragma once

#include "geometry/polygon.hpp"

namespace dim {

/// The region as rings without holes, for formats that know none: each hole is joined to the ring around it
/// by an edge that runs to and fro, the shortest that crosses nothing. Counter-clockwise, in the polygon's
/// local coordinates; corners keep every digit and the signed areas add up to the polygon's.
std::vector<Ring2> bridged_rings(const Polygon& polygon);

}  // namespace dim
