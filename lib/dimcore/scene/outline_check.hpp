#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/polygon.hpp"

namespace dim {

/// Largest distance of a corner from the best-fit plane of its polygon, as a fraction of the polygon's size
/// (the diagonal of its bounding box). Within it corners are moved onto the plane: the cracks this opens are
/// below the 0.1 % of flux that is the accuracy aimed at. Beyond it (the red wall of the Cornell box
/// data, 1.0e-3) a surface is refused with the deviation, because the cure, two triangles, is exact.
inline constexpr double kPlanarityTolerance = 1e-4;

/// Smallest area as a fraction of the square of the outline's length; below it a polygon has no direction.
inline constexpr double kMinRelativeArea = 1e-10;

/// Most corners of one outline.
inline constexpr std::size_t kMaxCorners = 10000;

/// Checks an outline and its holes, in metres near the origin, and takes out corners that repeat the one
/// before. Reports fewer than three corners, zero area, corners out of plane, an outline or hole that touches
/// or crosses itself, and holes that leave the outline or touch it or each other.
/// @param label  "surface 'floor'" for messages
/// @returns whether a polygon can be made of them
bool check_outline(Ring3& outline, std::vector<Ring3>& holes, const std::string& label, const Place& place,
                   Problems& problems);

}  // namespace dim
