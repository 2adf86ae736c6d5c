#pragma once

#include "geometry/polygon.hpp"
#include "geometry/segment.hpp"

namespace dim {

/// A directed line in a plane; what lies to its left has positive height.
struct Line2 {
  Vec2 normal{0.0};  ///< unit, to the left
  double offset = 0.0;

  double height(const Vec2& p) const { return glm::dot(normal, p) - offset; }
};

/// The line along a segment of some length.
Line2 line_through(const Segment2& segment);

/// Whether the segment runs through the inside of a convex ring: more than `rounding_m` of its length does,
/// and the ring reaches farther than that on both sides of its line.
bool passes_through(const Segment2& segment, const Ring2& convex, double rounding_m);

/// Both parts of a convex ring that the line passes through, corners in the ring's order. Corners within
/// `rounding_m` of the line count as lying on it, so that no edge shorter than that arises; the parts share
/// the corners of the cut, and their areas add up to the ring's.
void split_convex(const Ring2& convex, const Line2& line, double rounding_m, Ring2& left, Ring2& right);

/// Twice the area over the length around: the width of what is long and thin.
double mean_width_m(const Ring2& ring);

/// Whether two segments have a point in common.
bool segments_meet(const Segment2& s, const Segment2& t);

double distance_m(const Vec2& p, const Segment2& segment);

}  // namespace dim
