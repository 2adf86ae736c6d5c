#pragma once

#include <vector>

#include "geometry/box_tree.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Bounding boxes of surfaces along the axes of the largest of them: in a room that is turned as a whole they
/// are as tight as in one that is not. A surface without area has an empty box, which meets nothing.
/// @returns [n_surfaces]
std::vector<Box3> surface_boxes(const std::vector<Surface>& surfaces);

}  // namespace dim
