#pragma once

#include <array>

#include "geometry/cell_grid.hpp"

namespace dim {

/// Makes the cells of a CellGrid, square by square.
class CellGridBuilder {
 public:
  CellGridBuilder(CellGrid& grid, const Polygon& polygon, std::span<const Segment2> joints, double narrow_m);
  void build();

 private:
  // An edge of the polygon, the polygon on its left, or a joint.
  struct Barrier {
    Segment2 segment;
    bool edge;
    std::uint64_t order;
  };
  struct Passage {
    std::uint64_t square;
    std::uint32_t barrier;
  };

  // Edges decide what area there is: less of it may go by rounding than of where joints lie.
  double rounding_m(const Barrier& barrier) const { return barrier.edge ? 1e-2 * rounding_m_ : rounding_m_; }
  void collect_barriers(std::span<const Segment2> joints);
  void find_passages();
  void find_references();
  std::span<const Passage> passages(std::size_t square) const;
  Vec2 low(int i, int j) const;
  Vec2 middle(int i, int j) const;
  Vec2 reference(int i, int j) const;
  bool is_inside(const Vec2& p) const;
  void make_square();
  void mark_middle();
  std::int32_t divide(const Ring2& piece, const std::vector<std::uint32_t>& through, bool known_inside);
  bool passes_through(std::uint32_t barrier, const Ring2& piece) const;
  std::int32_t add_square(const Vec2& low, const Vec2& high);
  std::int32_t add_cell(const Ring2& piece);
  void absorb_narrow();
  std::int32_t host_of(std::size_t cell) const;
  bool meets_barrier(const Segment2& way) const;
  void renumber(const std::vector<std::int32_t>& hosts);
  void store_shapes();
  void fill_empty_squares();

  CellGrid& grid_;
  const Polygon& polygon_;
  double narrow_m_;
  double rounding_m_;  // what lies nearer to a line lies on it
  std::vector<Barrier> barriers_;
  std::vector<Passage> passages_;      // by square, then barrier
  std::vector<bool> inside_;           // [squares] whether the reference lies in the polygon
  std::array<int, 2> square_{};        // being made
  std::span<const Passage> near_;      // its barriers
  std::vector<Ring2> shapes_;          // of the cells that are not whole
  std::vector<std::uint32_t> narrow_;  // cells
};

}  // namespace dim
