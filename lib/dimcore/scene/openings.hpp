#pragma once

#include <vector>

#include "scene/shell_edges.hpp"
#include "scene/zone.hpp"

namespace dim {

/// What is open in a shell that is not closed, as flat polygons facing into the zone: the edges that nothing
/// meets joined to loops. Nothing where they do not join, where a loop is not flat, or where the polygons do
/// not close the shell: then only rays know what is open.
/// @param surfaces  parents before features are cut from them
/// @param leaking   of `check_shell`
/// @param touch_m   distance within which edges are the same
std::vector<Polygon> find_openings(const std::vector<Surface>& surfaces, const std::vector<LeakingEdge>& leaking,
                                   double touch_m);

}  // namespace dim
