#pragma once

#include "geometry/convex_ring.hpp"
#include "scene/lights.hpp"

namespace dim {

/// Where a luminaire's light leaves, in the zone's metres: a convex polygon, a segment or a point. Round
/// openings are polygons of 32 corners and of the same area.
struct OpeningRegion {
  ConvexRing ring;
  ConvexRing bounds;  ///< at most four corners; holds the ring
  Vec3 normal{0.0};   ///< unit normal of its plane (the aim where it has none)
  double measure = 1.0;  ///< of the ring, see ConvexRing::measure
};

OpeningRegion opening_region(const Luminaire& luminaire);

}  // namespace dim
