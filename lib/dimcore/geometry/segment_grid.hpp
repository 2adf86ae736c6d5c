#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// Finds which of many segments in a picture may meet a given one: squares, each with a list of the segments
/// that pass through it.
class SegmentGrid {
 public:
  /// @param n_segments  how many will be added: chooses the size of the squares
  SegmentGrid(int width, int height, std::size_t n_segments);

  void add(std::uint32_t index, const Vec2& a, const Vec2& b);

  /// Every segment added that shares a square with a-b, by ascending index, once each.
  void near(const Vec2& a, const Vec2& b, std::vector<std::uint32_t>& found) const;

 private:
  template <class Function>
  void for_squares(const Vec2& a, const Vec2& b, Function&& f) const;

  double square_px_ = 1.0;
  int nx_ = 1;
  int ny_ = 1;
  std::vector<std::vector<std::uint32_t>> squares_;
};

}  // namespace dim
