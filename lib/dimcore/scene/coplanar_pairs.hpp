#pragma once

#include <vector>

#include "geometry/clip.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Two surfaces in one plane whose bounding rectangles overlap by more than the tolerance. `large` is the one
/// of greater area; the corners of `small` lie within the tolerance of its plane.
struct CoplanarPair {
  std::size_t large = 0;
  std::size_t small = 0;
  bool same_facing = false;
};

/// All such pairs, in order of index; external obstructions, surfaces without area and twins are left out.
/// @throws InputError  when there are more than 10,000 + 50 a surface: things piled up at one place
std::vector<CoplanarPair> coplanar_pairs(const std::vector<Surface>& surfaces, double touch_m);

/// The region of `other` in the frame of `base`, brought to `base` where they nearly touch.
Region2 region_in_frame(const Polygon& other, const Polygon& base, double touch_m);

/// What two polygons of one plane share, m2; slivers of rounding do not count.
double common_area_m2(const Polygon& base, const Polygon& other, double touch_m);

/// Takes polygons of the same plane, facing either way, out of one; what is covered wholly is left empty.
void cut_out(Polygon& polygon, const std::vector<const Polygon*>& others, double touch_m);

/// Whether all corners of `polygon` lie within the tolerance of the plane; the largest distance if asked for.
bool lies_in_plane(const Polygon& polygon, const Frame& plane, double tolerance_m, double* worst_m = nullptr);

}  // namespace dim
