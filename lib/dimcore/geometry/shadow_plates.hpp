#pragma once

#include <vector>

#include "geometry/ray_caster.hpp"
#include "geometry/shaft.hpp"

namespace dim {

/// Parts of [0, 1] that are covered, in any order until `merge`.
class Intervals {
 public:
  void clear() { parts_.clear(); }
  void add(double low, double high) {
    if (high > low) parts_.push_back({low, high});
  }
  /// Sorts and joins; parts that nearly touch (1e-7) are joined, so that plates that share an edge leave no
  /// crack between.
  void merge();
  struct Part {
    double low, high;
  };
  const std::vector<Part>& parts() const { return parts_; }

 private:
  std::vector<Part> parts_;
};

/// The zone's plates as things that throw shadows: which of them can stand between two regions, whether one
/// hides a region wholly, and which part of a segment one hides from a point. Exact to rounding, where rays
/// only sample. Agrees with `RayCaster` on what stops light (backs that let pass, filled rectangles).
class ShadowPlates {
 public:
  /// @param plates  as for RayCaster; their polygons must outlive this
  ShadowPlates(const std::vector<Plate>& plates, double diameter_m);

  enum class Cover {
    none,  ///< not in the way of any line between the two
    part,
    whole  ///< in the way of every line
  };
  Cover cover(int plate, const Shaft& shaft) const;

  /// Plates whose cover is not none, ascending.
  void candidates(const Shaft& shaft, std::vector<int>& found) const;

  /// Where on the way from p (0) to q (1) the plate's plane is crossed; 1/2 where it is not, or at an end.
  double crossing_share(int plate, const Vec3& p, const Vec3& q) const;

  /// Adds the parts of the segment a..b (0 at a, 1 at b) that `plate` hides from `eye`.
  /// @param looks_from  whether rays start at the eye (as the shaft's first ring) or on the segment: from
  ///                    behind they pass a plate with an open back
  enum class LooksFrom { eye, segment };
  void add_hidden(int plate, const Vec3& eye, const Vec3& a, const Vec3& b, LooksFrom looks_from,
                  Intervals& hidden) const;

 private:
  struct Shadowing {
    Vec3 n, u, v;
    double n0, u0, v0;
    Vec2 size_m;
    const Polygon* polygon;
    bool rectangle, convex, open_back;
    Vec3 low, high;
    /// Coordinates in its plane and height over it.
    Vec3 local(const Vec3& p) const { return {glm::dot(u, p) - u0, glm::dot(v, p) - v0, glm::dot(n, p) - n0}; }
  };
  struct Node {
    Vec3 low, high;
    int first, count;  // plates in order_, or (count 0) the children: the next node and `first`
  };
  int build(int first, int last);
  Cover region_cover(const Shadowing& plate, const ConvexRing& front, const ConvexRing& back) const;
  void add_outline(const Shadowing& plate, const Vec2& eye, double he, const Vec2& a, double ha, const Vec2& b,
                   double hb, double low, double high, Intervals& hidden) const;

  double tolerance_m_;
  std::vector<Shadowing> plates_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace dim
