#include "geometry/cell_grid.hpp"

#include <cmath>

#include "base/error.hpp"
#include "geometry/cell_grid_builder.hpp"

namespace dim {
namespace {

double unlimited_steps(double length_m, double step_m) {
  constexpr double kRounding = 1e-9;
  const double steps = std::ceil(length_m / step_m - kRounding);
  return steps < 1.0 ? 1.0 : steps;
}

}  // namespace

double n_squares(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid) {
  if (grid) return static_cast<double>(grid->first) * grid->second;
  const Vec2 size = polygon.size_m();
  return unlimited_steps(size.x, cell_m) * unlimited_steps(size.y, cell_m);
}

int n_steps(double length_m, double step_m) {
  const double steps = unlimited_steps(length_m, step_m);
  if (!(steps < 1e8)) throw LimitError("a grid of more than 1e8 squares along one edge; use a larger --cell");
  return static_cast<int>(steps);
}

CellGrid::CellGrid(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid,
                   std::span<const Segment2> joints, double narrow_m)
    : size_m_(polygon.size_m()) {
  nu_ = grid ? grid->first : n_steps(size_m_.x, cell_m);
  nv_ = grid ? grid->second : n_steps(size_m_.y, cell_m);
  if (nu_ < 1 || nv_ < 1 || static_cast<double>(nu_) * nv_ > kMaxSquares)
    throw LimitError("a grid of " + std::to_string(nu_) + " x " + std::to_string(nv_) +
                     " squares on one surface; use a larger --cell");
  per_m_ = {nu_ / size_m_.x, nv_ / size_m_.y};
  regular_ = polygon.is_rectangle() && joints.empty();
  CellGridBuilder(*this, polygon, joints, narrow_m).build();
}

void CellGrid::outline(std::size_t cell, Ring2& corners) const {
  const GridCell& c = cells_[cell];
  if (c.whole) {
    corners = {c.low, {c.high.x, c.low.y}, c.high, {c.low.x, c.high.y}};
    return;
  }
  const auto at = [&](std::uint32_t shape) { return corners_.begin() + first_corner_[shape]; };
  corners.assign(at(c.shape), at(c.shape + 1));
}

// Whether the middles of a square and of its neighbour along one axis are apart; the neighbour exists.
bool CellGrid::cut_between(int square, int di, int dj) const {
  if (di + dj < 0) square += di + dj * nu_;
  return (middles_[static_cast<std::size_t>(square)] & (di != 0 ? kCutFromRight : kCutFromUpper)) != 0;
}

int CellGrid::middle_cell(int square, int di, int dj) const {
  const int i = square % nu_ + di, j = square / nu_ + dj;
  if (i < 0 || j < 0 || i >= nu_ || j >= nv_) return -1;
  const int other = j * nu_ + i;
  if (regular_) return other;
  if ((middles_[static_cast<std::size_t>(other)] & kNoMiddle) != 0) return -1;
  if (di != 0 && dj != 0) {  // round either corner
    if ((cut_between(square, di, 0) || cut_between(square + di, 0, dj)) &&
        (cut_between(square, 0, dj) || cut_between(square + dj * nu_, di, 0)))
      return -1;
  } else if (di + dj != 0 && cut_between(square, di, dj)) {
    return -1;
  }
  const Vec2 middle(size_m_.x * (i + 0.5) / nu_, size_m_.y * (j + 0.5) / nv_);
  return descend(cell_of_square_[static_cast<std::size_t>(other)], middle);
}

}  // namespace dim
