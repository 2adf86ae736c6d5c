#pragma once

#include <cstdint>

#include "geometry/convex_ring.hpp"
#include "geometry/polygon.hpp"
#include "hemisphere/response.hpp"

namespace dim {

/// Where daylight is received: a convex cell, or a measuring point (a ring of one corner).
struct ReceiverArea {
  Response response;
  ConvexRing ring;
  int skip = -1;             ///< plate it lies on, or -1
  std::uint64_t stream = 0;  ///< its own chance

  bool is_point() const { return ring.size() == 1; }
  /// A point of it, a little off its edges: what starts on a wall at a cell's edge would pass through that.
  Vec3 at(double a, double b) const {
    constexpr double kInwards = 1e-6;
    if (is_point()) return ring[0];
    return glm::mix(ring.sample(a, b), ring.middle(), kInwards);
  }
};

}  // namespace dim
