#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/convex_split.hpp"
#include "geometry/polygon.hpp"
#include "geometry/segment.hpp"

namespace dim {

/// One finite element of a surface, a convex polygon in the polygon's local frame.
struct GridCell {
  Vec2 low{0.0};  ///< bounds
  Vec2 high{0.0};
  Vec2 centroid{0.0};
  double area_m2 = 0.0;
  bool whole = true;        ///< exactly the rectangle from low to high
  std::uint32_t shape = 0;  ///< of those that are not whole: number among them, see CellGrid::outline
};

/// nu x nv squares on the polygon's bounding rectangle, each divided into convex cells that end where the
/// polygon does and where other surfaces touch it.
///
/// A square that an edge of the polygon or a joint passes through is halved along the line of that edge or
/// joint, each half again where another passes through it, and so on; halves outside the polygon are left
/// out. A cell therefore lies on one side of every joint. The cells' areas add up to the polygon's to 1e-12.
///
/// Parts narrower than `narrow_m` become no cells, because no ray can start in them: their area and whatever
/// arrives there belong to the cell next to them that neither an edge nor a joint separates from them.
class CellGrid {
 public:
  /// Squares of at most `cell_m` along both edges, or exactly `grid` = nu x nv squares.
  /// @param cell_m    > 0; ignored when grid is given
  /// @param joints    where other surfaces touch or cross the polygon, local; the parts beyond its bounding
  ///                  rectangle do not matter
  /// @param narrow_m  >= 0, 0: 1e-8 of the polygon's extent. What differs by 1e-4 of it is the same.
  explicit CellGrid(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid = {},
                    std::span<const Segment2> joints = {}, double narrow_m = 0.0);

  int nu() const { return nu_; }
  int nv() const { return nv_; }
  const std::vector<GridCell>& cells() const { return cells_; }
  /// Every square is a cell, and nothing stands between them.
  bool regular() const { return regular_; }

  /// The cell at a local point. Points outside the polygon (by rounding) get a cell nearby.
  int cell_at(const Vec2& p) const {
    const int square = square_at(p);
    return regular_ ? square : descend(cell_of_square_[static_cast<std::size_t>(square)], p);
  }

  /// Corners of a cell, counter-clockwise, local.
  void outline(std::size_t cell, Ring2& corners) const;

  /// The square that holds a local point, i + j nu; the nearest one for points outside.
  int square_at(const Vec2& p) const {
    const int i = static_cast<int>(p.x * per_m_.x), j = static_cast<int>(p.y * per_m_.y);
    return (j < 0 ? 0 : (j >= nv_ ? nv_ - 1 : j)) * nu_ + (i < 0 ? 0 : (i >= nu_ ? nu_ - 1 : i));
  }

  /// The cell in the middle of the square (di, dj) on from a square, each -1, 0 or 1. -1 where the middle is
  /// not inside the polygon or where an edge or a joint stands between it and the first square's middle.
  int middle_cell(int square, int di, int dj) const;

 private:
  friend class CellGridBuilder;

  // Divides a square. What lies left or right: >= 0 a cell, < 0 the complement of a node's index.
  struct Node {
    Line2 line;
    std::int32_t left, right;
  };
  // What is known of a square's middle.
  enum : std::uint8_t { kCutFromRight = 1, kCutFromUpper = 2, kNoMiddle = 4 };

  int descend(std::int32_t at, const Vec2& p) const {
    while (at < 0) {
      const Node& node = nodes_[static_cast<std::size_t>(~at)];
      at = node.line.height(p) >= 0.0 ? node.left : node.right;
    }
    return at;
  }
  bool cut_between(int square, int di, int dj) const;

  int nu_ = 1;
  int nv_ = 1;
  Vec2 size_m_{0.0};
  Vec2 per_m_{0.0};
  bool regular_ = true;
  std::vector<GridCell> cells_;
  std::vector<std::int32_t> cell_of_square_;  ///< as Node's children; that of a square nearby where empty
  std::vector<Node> nodes_;
  std::vector<std::uint8_t> middles_;
  std::vector<Vec2> corners_;                ///< of the cells that are not whole, one after the other
  std::vector<std::uint32_t> first_corner_;  ///< [shapes + 1]
};

/// Most squares of one grid.
inline constexpr double kMaxSquares = 2e9;

/// Number of squares that a CellGrid of these arguments has, without making it; not limited.
double n_squares(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid = {});

/// Number of grid steps of at most `step_m` that cover `length_m`, at least 1. Lengths that exceed a whole
/// number of steps only by rounding do not get one more.
int n_steps(double length_m, double step_m);

}  // namespace dim
