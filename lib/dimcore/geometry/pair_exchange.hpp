#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// A · F between two plane regions with nothing between them, m²: the diffuse exchange area of radiative heat
/// transfer, symmetric in its arguments. Divide by a region's area for its view factor to the other.
///
/// Stokes' theorem turns the double area integral into one round both outlines (Sparrow 1963; Howell's
/// catalogue, introduction): A F = 1/(2 pi) times the sum over edges of (e·f) times the double integral of ln
/// r. Parallel edges, touching or not, in closed form; edges far apart by Gauss's rule in both; others
/// exactly along one and by Gauss's rule on the other, halved towards the place where they meet. Relative
/// error below 1e-6, down to regions that are 1e-3 of their distance.
///
/// @param a, b  rings as Polygon::corners() gives them: counter-clockwise seen from the lit side, holes
///              clockwise. Every point of each must see the front of the other: see `front_part`.
double pair_exchange_m2(const std::vector<Ring3>& a, const std::vector<Ring3>& b);

/// The part of a region (rings in one plane) that lies in front of a plane, in the sense that signed areas
/// and contour integrals over its rings are right; corners within `tolerance_m` count as in front. Empty
/// where no corner is farther in front than that.
std::vector<Ring3> front_part(const std::vector<Ring3>& rings, const Frame& plane, double tolerance_m);

}  // namespace dim
