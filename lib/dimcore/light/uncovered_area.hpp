#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "geometry/polygon.hpp"

namespace dim {

/// A small convex polygon in a plane that half-planes are cut off from. In place, without allocation.
class ConvexPatch {
 public:
  static constexpr std::size_t kMostCorners = 96;

  void add(const Vec2& corner) { corner_[n_++] = corner; }
  bool empty() const { return n_ < 3; }
  /// Keeps what has a + b x + c y >= 0.
  void keep(double a, double b, double c);
  double area() const;
  /// Of the area; the patch must have one.
  Vec2 centroid() const;
  std::span<const Vec2> corners() const { return {corner_.data(), n_}; }

 private:
  std::size_t n_ = 0;
  std::array<Vec2, kMostCorners> corner_;
};

/// A region that hides what lies below it: rings by the even-odd rule.
using CoverRings = std::vector<Ring2>;

/// Area of the patch that no cover hides: along a few dozen lines, exact on each.
/// @error  below 1 % of the patch where one edge crosses it, none where nothing does
double uncovered_area(const ConvexPatch& patch, const std::vector<CoverRings>& covers);

}  // namespace dim
