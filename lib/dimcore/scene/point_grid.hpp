#pragma once

#include <vector>

#include "scene/point_quantity.hpp"
#include "scene/zone.hpp"

namespace dim {

class TomlTable;

/// Largest number of measuring points of one plane.
inline constexpr std::size_t kMaxPoints = 10'000'000;

/// Greatest distance of points on an area of d metres: p = 0.2 * 5^log10(d), at most 10 m. After EN 12464-1.
/// @param size_m  of the area: d is the longer side, the shorter one where that is at most half of it
double spacing_en12464_m(const Vec2& size_m);

/// Squares of at most the spacing along both sides of the plane, into nu and nv.
/// @returns false where they are too many, which is reported at `key` of the table
bool divide(const TomlTable& table, const char* key, double spacing_m, MeasuringPlane& plane);

/// Adds the plane to the zone, once for each way its points face: they are the middles of its squares within it.
/// Too many of them, or none, are reported.
void add_plane(const TomlTable& table, MeasuringPlane plane, const std::vector<Facing>& facings, Zone& zone);

}  // namespace dim
