#pragma once

#include <vector>

#include "geometry/clip.hpp"
#include "image/contour_field.hpp"

namespace dim {

/// A line of one value, in metres on the field's rectangle; what is higher lies to its left. A closed line
/// does not repeat its first point.
struct Isoline {
  std::vector<Vec2> points;
  bool closed = false;
};

/// The lines on which the field has the value `level`, by marching squares: straight across each square of
/// the lattice. Squares that could be joined either way are joined as the bilinear surface through their
/// corners is, so that lines of one level never cross, nor those of different levels. They are closed or end
/// where the field does. A value equal to the level counts as above it, so a constant field has no lines.
std::vector<Isoline> isolines(const Lattice& field, double level);

/// Where the field is known and at least `level`: outer rings counter-clockwise, holes clockwise; bounded by
/// the same lines and by the field's edge.
Region2 region_above(const Lattice& field, double level);

/// The parts of a line that lie in a region.
std::vector<Isoline> clipped(const Isoline& line, const Region2& region);

/// Whether a point lies in a region (even-odd).
bool contains(const Region2& region, const Vec2& p);

}  // namespace dim
