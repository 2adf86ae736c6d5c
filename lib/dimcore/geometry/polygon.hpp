#pragma once

#include <array>
#include <vector>

#include "base/vec.hpp"

namespace dim {

using Ring2 = std::vector<Vec2>;  ///< closed implicitly; last corner not repeated
using Ring3 = std::vector<Vec3>;

/// Orthonormal right-handed frame of a plane: point = origin + x*u + y*v, normal n = u x v.
struct Frame {
  Vec3 origin{0.0};
  Vec3 u{1, 0, 0};
  Vec3 v{0, 1, 0};
  Vec3 n{0, 0, 1};

  Vec3 to_world(const Vec2& p) const { return origin + p.x * u + p.y * v; }
  Vec2 to_local(const Vec3& p) const {
    const Vec3 d = p - origin;
    return {glm::dot(d, u), glm::dot(d, v)};
  }
  double height(const Vec3& p) const { return glm::dot(p - origin, n); }
  Vec3 direction_to_world(const Vec3& d) const { return d.x * u + d.y * v + d.z * n; }
  Vec3 direction_to_local(const Vec3& d) const { return {glm::dot(d, u), glm::dot(d, v), glm::dot(d, n)}; }
};

/// A planar region: one or more outer rings and any number of holes, given in its own frame.
///
/// The frame's u runs along the longest edge of the outline and the region's bounding rectangle has its lower
/// corner at the frame's origin, so that local coordinates run over [0, width] x [0, height]. Outer rings are
/// counter-clockwise, holes clockwise, seen from the lit side (against n).
class Polygon {
 public:
  Polygon() = default;

  /// From corners in space, counter-clockwise seen from the lit side. The plane is Newell's best fit; corners
  /// are projected on it (see `planarity_error_m`). Holes may run either way.
  /// @throws InternalError for fewer than three corners or zero area: callers check input first
  explicit Polygon(const Ring3& outline, const std::vector<Ring3>& holes = {});

  /// From rings in a known frame (the result of cutting): outer rings counter-clockwise, holes clockwise. The
  /// frame's axes are kept, its origin moves to the lower corner of the bounding rectangle.
  Polygon(const Frame& frame, std::vector<Ring2> rings);

  const Frame& frame() const { return frame_; }
  const std::vector<Ring2>& rings() const { return rings_; }
  Vec2 size_m() const { return size_m_; }  ///< extent of the bounding rectangle along u and v
  double area_m2() const { return area_m2_; }
  Vec3 centroid() const { return frame_.to_world(centroid_); }
  const Vec3& normal() const { return frame_.n; }
  /// True where the region is exactly its bounding rectangle.
  bool is_rectangle() const { return is_rectangle_; }

  /// Whether the local point lies inside, or within `tolerance_m` of the boundary.
  bool contains(const Vec2& p, double tolerance_m = 0.0) const;

  /// The same region seen from the other side.
  Polygon reversed() const;

  /// All corners in space, ring after ring.
  std::vector<Ring3> corners() const;

 private:
  void measure();

  Frame frame_;
  std::vector<Ring2> rings_;
  Vec2 size_m_{0.0};
  Vec2 centroid_{0.0};
  double area_m2_ = 0.0;
  bool is_rectangle_ = false;
};

/// Twice the vector area of a closed ring (Newell): direction is the normal, length twice the area.
Vec3 newell(const Ring3& ring);

/// Largest distance of a corner from the best-fit plane of the ring, metres.
double planarity_error_m(const Ring3& ring);

/// Signed area, positive for counter-clockwise.
double signed_area(const Ring2& ring);

/// Signed area and first moments of a ring: {area, integral of x, integral of y}.
std::array<double, 3> area_moments(const Ring2& ring);

}  // namespace dim
