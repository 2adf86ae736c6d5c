#pragma once

#include <vector>

#include "base/vec.hpp"

namespace dim {

/// Pixels of a picture that an edge may pass through, hidden or not: all others show one surface each.
class EdgeMask {
 public:
  /// @param width, height  of the picture, pixels
  EdgeMask(int width, int height);

  /// The line between two places in the picture, or beside it, has an edge on it.
  void add(const Vec2& a, const Vec2& b);

  bool at(int x, int y) const { return marked_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void mark(double along, double from, double to, bool steep);

  int width_, height_;
  std::vector<bool> marked_;
};

}  // namespace dim
