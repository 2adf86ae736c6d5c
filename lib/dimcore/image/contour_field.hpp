#pragma once

#include <vector>

#include "base/vec.hpp"

namespace dim {

/// Values at the middles of nu x nv squares of a rectangle [0, size].
struct ValueGrid {
  int nu = 1, nv = 1;
  Vec2 size_m{0.0};
  std::vector<double> values;  ///< [nv, nu], u fastest; NaN where nothing is known
};

/// A field at the crossings of nx x ny lines of a rectangle, its edges included.
struct Lattice {
  int nx = 0, ny = 0;
  Vec2 step_m{0.0};
  std::vector<double> values;  ///< [ny, nx], x fastest; NaN where the field is not known

  double at(int i, int j) const { return values[static_cast<std::size_t>(j * nx + i)]; }
  Vec2 place(int i, int j) const { return {i * step_m.x, j * step_m.y}; }
};

/// The smooth field through the values: cubic along u and then along v (slopes of fourth order where four
/// neighbours are known), so that its error shrinks with the fourth power of the squares. Next to a step, a
/// shadow's edge say, the slopes are limited as Hyman (1983) has it, and the field overshoots nowhere; at a
/// smooth maximum, where second differences are of one sign, they are not. Beyond the outermost middles, and
/// half a square into squares without a value, the field is extrapolated by a cubic where its curvature
/// goes on alike, and not below zero where no value is. A single row or a single value is constant across.
/// @param step_m  the lattice's lines are at most as far apart
/// @throws InternalError  sizes that do not belong together
Lattice smooth_field(const ValueGrid& grid, double step_m);

}  // namespace dim
