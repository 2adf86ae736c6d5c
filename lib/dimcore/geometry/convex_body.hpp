#pragma once

#include <vector>

#include "geometry/clip.hpp"
#include "geometry/polygon.hpp"

namespace dim {

/// A convex solid as its faces, in any order, or a flat convex piece as one face. No faces: nothing.
struct ConvexBody {
  std::vector<Ring3> faces;

  bool flat() const { return faces.size() == 1; }
};

/// The flat piece that the outline of a polygon spans (its convex hull).
ConvexBody hull_of(const Polygon& polygon);

/// Where the plane goes through the body: corners counter-clockwise seen from in front, two of a flat piece.
/// Empty where the body does not reach farther than `touch_m` on both sides.
Ring3 section(const ConvexBody& body, const Frame& plane, double touch_m);

/// The part in front of the plane. A solid that is cut is closed by its section, as the last face.
ConvexBody front_of(const ConvexBody& body, const Frame& plane, double touch_m);

/// A section as a region of its plane: that of a flat piece as a strip three times `touch_m` wide.
Region2 section_region(const Ring3& section, const Frame& plane, double touch_m);

/// Whether a polygon stands in the body's inside or goes through it; what only touches it does not.
bool pierces(const Polygon& polygon, const ConvexBody& body, double touch_m);

/// Mean of the corners of all faces.
Vec3 middle_of(const ConvexBody& body);

}  // namespace dim
