#pragma once

#include "base/vec.hpp"

namespace dim {

/// A straight line between two points of a plane.
struct Segment2 {
  Vec2 a{0.0};
  Vec2 b{0.0};
};

/// The third component of a x b: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace dim
