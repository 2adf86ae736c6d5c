#pragma once

#include <span>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// A half-space: the points with dot(normal, p) >= offset.
struct HalfSpace {
  Vec3 normal{0, 0, 1};
  double offset = 0.0;
  double height(const Vec3& p) const { return glm::dot(normal, p) - offset; }
};

/// A convex region of space that light of a source keeps to, as half-spaces; without any, all of space.
struct Beam {
  std::vector<HalfSpace> limits;

  /// Whether all corners of something convex lie outside, by more than `tolerance_m`. Never true of what
  /// light reaches; of what it misses only where one limit says so.
  bool misses(std::span<const Vec3> corners, double tolerance_m) const;

  /// The part of a planar convex ring that lies inside, corners in the same order; empty where nothing does.
  Ring3 part_of(const Ring3& ring) const;
};

/// Where light from anywhere on an opening can be once it has come out of an aperture: in front of its plane
/// and, edge by edge, within the plane through that edge and the corner of the opening from which light
/// reaches furthest. Exact for a point source; for others the hull of all their points' beams, edge by edge.
///
/// @param aperture  convex, counter-clockwise seen from where light comes out
/// @param normal    of its plane, unit, to where light comes out
/// @param opening   corners of the opening's hull, at least one. Edges that the opening is not wholly behind
///                  limit nothing.
Beam beam_through(const Ring3& aperture, const Vec3& normal, std::span<const Vec3> opening);

/// Corners of the convex hull of points in a plane, counter-clockwise.
Ring2 convex_hull(std::vector<Vec2> points);

}  // namespace dim
