#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// One finite element of a surface: a grid square clipped to the polygon, in the polygon's local frame.
struct GridCell {
  Vec2 low{0.0};  ///< bounds of the square
  Vec2 high{0.0};
  Vec2 centroid{0.0};  ///< of the clipped region
  double area_m2 = 0.0;
  bool whole = true;  ///< the square lies entirely inside the polygon
};

/// nu x nv grid on the polygon's bounding rectangle, clipped exactly to the polygon.
///
/// Every square with some of the polygon in it is one cell; the cells' areas add up to the polygon's to
/// 1e-12. Squares that hold less than 1e-13 of their own area count as empty.
class CellGrid {
 public:
  /// Squares of at most `cell_m` along both edges, or exactly `grid` = nu x nv squares.
  /// @param cell_m  > 0; ignored when grid is given
  CellGrid(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid = {});

  int nu() const { return nu_; }
  int nv() const { return nv_; }
  const std::vector<GridCell>& cells() const { return cells_; }

  /// The cell at a local point. Points outside the polygon (by rounding) get the nearest square's cell.
  int cell_at(const Vec2& p) const {
    int i = static_cast<int>(p.x * per_m_.x);
    int j = static_cast<int>(p.y * per_m_.y);
    i = i < 0 ? 0 : (i >= nu_ ? nu_ - 1 : i);
    j = j < 0 ? 0 : (j >= nv_ ? nv_ - 1 : j);
    return regular_ ? j * nu_ + i : cell_of_square_[static_cast<std::size_t>(j * nu_ + i)];
  }

  /// Cell of square (i, j), or -1 where the square holds nothing of the polygon.
  int cell_of_square(int i, int j) const;

 private:
  void clip(const Polygon& polygon);
  void fill_empty_squares();

  int nu_ = 1;
  int nv_ = 1;
  Vec2 step_m_{0.0};
  Vec2 per_m_{0.0};
  bool regular_ = true;  ///< every square is a cell: the polygon is its bounding rectangle
  std::vector<GridCell> cells_;
  std::vector<std::int32_t> cell_of_square_;  ///< nearest cell where the square is empty
  std::vector<bool> empty_;
};

/// Most squares of one grid.
inline constexpr double kMaxSquares = 2e9;

/// Number of squares that a CellGrid of these arguments has, without making it; not limited.
double n_squares(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid = {});

/// Number of grid steps of at most `step_m` that cover `length_m`, at least 1. Lengths that exceed a whole
/// number of steps only by rounding do not get one more.
int n_steps(double length_m, double step_m);

/// A ring clipped to the half-plane where coordinate `axis` is at most (sign > 0) or at least (sign < 0)
/// `limit`. Signed area and moments of the result are exact even where a concave ring falls into parts (they
/// stay joined along the limit).
Ring2 clip_half_plane(const Ring2& ring, int axis, double limit, double sign);

}  // namespace dim
