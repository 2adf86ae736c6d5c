#pragma once

#include "base/vec.hpp"

namespace dim {

/// A straight line between two points of a plane.
struct Segment2 {
  Vec2 a{0.0};
  Vec2 b{0.0};
};

}  // namespace dim
