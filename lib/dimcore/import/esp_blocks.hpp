#pragma once

#include <array>
#include <string>
#include <vector>

#include "import/imported_model.hpp"

namespace dim {

/// The six faces of an obstruction block of ESP-r, looking outwards.
/// @param corners  four below, counter-clockwise seen from above, then those above them
std::vector<ImportedFace> esp_block_faces(const std::array<Vec3, 8>& corners, const std::string& name,
                                          int material);

/// Corners of a block by its origin and edges, tilted (its length lifted, degrees) and turned (degrees about
/// the vertical, counter-clockwise) through its origin. Edges below 0 point the other way.
std::array<Vec3, 8> esp_block_corners(const Vec3& origin, Vec3 edges, double turn_deg, double tilt_deg);

}  // namespace dim
