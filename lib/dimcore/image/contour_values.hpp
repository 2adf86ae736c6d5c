#pragma once

#include <vector>

#include "image/contour_field.hpp"
#include "network/cells.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Values of a measuring plane's points on its grid; NaN outside the polygon and where a point is not valid.
/// @param values  [n_points] of the zone
ValueGrid values_on_plane(const Zone& zone, std::size_t plane, const std::vector<double>& values);

/// Values of a surface's cells on its grid of squares, the mean by area where a square has several cells; NaN
/// where it has none.
/// @param values  [n_cells]
ValueGrid values_on_surface(const Cells& cells, const Polygon& polygon, std::size_t surface,
                            const std::vector<double>& values);

}  // namespace dim
