#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// A planar region as Polygon holds it: outer rings counter-clockwise, holes clockwise, in one plane's
/// coordinates. Any number of either; the empty list is the empty region.
using Region2 = std::vector<Ring2>;

/// subject without clip, and what both cover. Corners of the operands that remain keep every digit; corners
/// where edges cross are good to 2^-50 of the operands' joint extent, so that areas are exact to about 1e-14
/// of it. (Clipper works in whole numbers; 50 bits rather than the 62 it allows, because it crosses edges in
/// double precision and larger numbers would be rounded inside it.)
Region2 clip_difference(const Region2& subject, const Region2& clip);
Region2 clip_intersection(const Region2& subject, const Region2& clip);

/// The region with a band of this width around it, corners kept sharp (blunt beyond twice the width); holes shrink.
/// @param width  >= 0
Region2 grown(const Region2& region, double width);

/// A polygon's outlines in the coordinates of another plane, each point at its foot. They run the other way round where
/// the two face apart.
Region2 projected(const Polygon& polygon, const Frame& onto);

/// Area of a region, holes taken away.
double area(const Region2& region);

/// Moves corners of `region` that lie within `tolerance` of a corner of `onto` to it, those within
/// `tolerance` of an edge of `onto` onto that edge, and gives edges of `region` a corner wherever one of
/// `onto` lies that near: what nearly touches then touches, and cutting leaves no sliver between.
Region2 snapped(const Region2& region, const Region2& onto, double tolerance);

/// Takes out rings (pieces and holes) of less mean width than `width`: rounding left over from cutting.
Region2 without_slivers(Region2 region, double width);

}  // namespace dim
