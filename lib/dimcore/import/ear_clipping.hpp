#pragma once

#include <array>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// Cuts a ring into triangles of its corners (numbers within the ring), counter-clockwise as the ring is.
/// Rings may run to and fro along one edge; of rings that cross themselves the triangles cover some part.
std::vector<std::array<std::size_t, 3>> ear_triangles(const Ring2& ring);

}  // namespace dim
