#pragma once

#include <vector>

#include "geometry/perspective.hpp"
#include "geometry/segment.hpp"

namespace dim {

/// Pixels of a picture that an edge may pass through, hidden or not: all others show one surface each.
class EdgeMask {
 public:
  /// @param near_m  > 0: what is nearer to the eye is not in the picture
  EdgeMask(const Perspective& perspective, double near_m);

  void add(const Vec3& a, const Vec3& b);

  bool at(int x, int y) const { return marked_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(perspective_.width()) +
           static_cast<std::size_t>(x);
  }
  void mark(double along, double from, double to, bool steep);

  const Perspective& perspective_;
  double near_m_;
  std::vector<bool> marked_;
};

}  // namespace dim
