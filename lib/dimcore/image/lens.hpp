#pragma once

#include <optional>

#include "geometry/fisheye.hpp"
#include "geometry/perspective.hpp"
#include "image/edge_mask.hpp"
#include "scene/view.hpp"

namespace dim {

/// Along what line a place in a picture is seen.
struct Sight {
  Vec3 origin{0.0};
  Vec3 direction{1, 0, 0};  ///< unit
};

/// What the pixels of a view look along, whatever its kind.
class Lens {
 public:
  explicit Lens(const View& view);

  /// Nothing outside the circle of a round view. Pixel (i, j) has its middle at (i + 0.5, j + 0.5).
  std::optional<Sight> sight(double px, double py) const;

  /// Marks the pixels that a straight edge in space may pass through.
  /// @param near_m  > 0: what is nearer to the eye is not in the picture
  void mark_edge(const Vec3& a, const Vec3& b, double near_m, EdgeMask& mask) const;

  /// Marks the pixels in which the picture itself ends.
  void mark_rim(EdgeMask& mask) const;

 private:
  void mark_curved(const Vec3& a, const Vec3& b, double near_m, EdgeMask& mask) const;

  Perspective perspective_;  // of a round view, its axes alone are of use
  std::optional<Fisheye> fisheye_;
};

}  // namespace dim
