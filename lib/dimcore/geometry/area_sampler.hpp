#pragma once

#include <array>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// Points spread uniformly over a plane region with any number of outer rings and holes, none of them thrown
/// away: the region is cut at its corners' heights into trapezoids with level sides, one of which is chosen
/// by area and then filled through its exact inverse distribution. The map from the unit square is continuous
/// inside a trapezoid, so that evenly spread numbers give evenly spread points.
class AreaSampler {
 public:
  AreaSampler() = default;
  /// @param rings  any even-odd set of closed rings; parts of no area are left out
  explicit AreaSampler(const std::vector<Ring2>& rings);

  double area() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }

  /// The point for (a, b) in [0, 1) x [0, 1). The region must have an area.
  Vec2 point(double a, double b) const;

  /// The region as counter-clockwise triangles without overlap.
  std::vector<std::array<Vec2, 3>> triangles() const;

 private:
  struct Trapezoid {
    double y0, y1;          // lower and upper side
    double x0, x1;          // left and right end of the lower side
    double x0_top, x1_top;  // and of the upper one
  };
  std::vector<Trapezoid> trapezoids_;
  std::vector<double> cumulative_;  // area up to and including each
};

}  // namespace dim
