#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/segment.hpp"
#include "network/cells.hpp"

namespace dim {

/// Interpolates between cells: at each point the weighted mean of the cells round it.
///
/// A cell's weight is its share of a whole square times a tent round its middle that ends one square away; on a
/// grid of whole squares this is bilinear, and constant from the outer middles to the edge. Features and the
/// surface that they are cut out of blend as one, so that what is continuous on a wall stays so across them.
/// What a joint or the edge of all of them separates does not blend.
class CellBlend {
 public:
  /// @param joints  [n_surfaces] of `find_joints`
  CellBlend(const Zone& zone, const Cells& cells, const std::vector<std::vector<Segment2>>& joints);

  /// Calls f(cell, weight) for cells whose weights add up to 1.
  template <class Function>
  void visit(std::size_t surface, const Vec2& local, Function&& f) const {
    if (regular_[surface])
      visit_regular(surface, local, f);
    else
      visit_listed(surface, local, f);
  }

  /// Calls f(cell) for the cells that blend with a cell, itself among them.
  template <class Function>
  void visit_neighbours(std::size_t cell, Function&& f) const {
    const std::size_t surface = cells_.surface_of(cell);
    if (!regular_[surface]) {
      for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) f(static_cast<std::size_t>(listed_[k]));
      return;
    }
    const CellGrid& grid = cells_.grid(surface);
    const int own = static_cast<int>(cell - cells_.first(surface)), i = own % grid.nu(), j = own / grid.nu();
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di)
        if (i + di >= 0 && i + di < grid.nu() && j + dj >= 0 && j + dj < grid.nv())
          f(cells_.first(surface) + static_cast<std::size_t>(own + dj * grid.nu() + di));
  }

 private:
  friend class CellBlendBuilder;

  // Where a cell's tent stands, in the plane of its group of surfaces.
  struct Tent {
    Vec2 middle{0.0};
    Vec2 per_m{0.0};  // 1 / half width
    double share = 0.0;
    double at(const Vec2& p) const {
      const double x = 1.0 - std::abs(p.x - middle.x) * per_m.x, y = 1.0 - std::abs(p.y - middle.y) * per_m.y;
      return x > 0.0 && y > 0.0 ? share * x * y : 0.0;
    }
  };
  // From a surface's frame to its group's.
  struct Placing {
    Vec2 origin{0.0}, u{1, 0}, v{0, 1};
    Vec2 of(const Vec2& p) const { return origin + p.x * u + p.y * v; }
  };

  template <class Function>
  void visit_regular(std::size_t surface, const Vec2& local, Function& f) const {
    const CellGrid& grid = cells_.grid(surface);
    const Vec2 size = size_m_[surface];
    const auto between = [](double at, int n, int& low, double& weight) {
      const double x = std::min(std::max(at * n - 0.5, 0.0), n - 1.0);
      low = std::min(static_cast<int>(x), std::max(0, n - 2));
      weight = x - low;
    };
    int i = 0, j = 0;
    double wu = 0.0, wv = 0.0;
    between(local.x / size.x, grid.nu(), i, wu);
    between(local.y / size.y, grid.nv(), j, wv);
    const std::size_t cell = cells_.first(surface) + static_cast<std::size_t>(j * grid.nu() + i);
    const auto up = static_cast<std::size_t>(grid.nu());
    if (wu < 1.0 && wv < 1.0) f(cell, (1.0 - wu) * (1.0 - wv));
    if (wu > 0.0 && wv < 1.0) f(cell + 1, wu * (1.0 - wv));
    if (wu < 1.0 && wv > 0.0) f(cell + up, (1.0 - wu) * wv);
    if (wu > 0.0 && wv > 0.0) f(cell + up + 1, wu * wv);
  }

  template <class Function>
  void visit_listed(std::size_t surface, const Vec2& local, Function& f) const {
    const std::size_t own = cells_.first(surface) + static_cast<std::size_t>(cells_.grid(surface).cell_at(local));
    const Vec2 p = placing_[surface].of(local);
    double total = 0.0;
    for (std::size_t k = first_[own]; k < first_[own + 1]; ++k) total += tents_[listed_[k]].at(p);
    if (!(total > 0.0)) return f(own, 1.0);
    for (std::size_t k = first_[own]; k < first_[own + 1]; ++k) {
      const double weight = tents_[listed_[k]].at(p);
      if (weight > 0.0) f(static_cast<std::size_t>(listed_[k]), weight / total);
    }
  }

  const Cells& cells_;
  std::vector<Vec2> size_m_;          // [n_surfaces]
  std::vector<char> regular_;         // [n_surfaces]
  std::vector<Placing> placing_;      // [n_surfaces]
  std::vector<Tent> tents_;           // [n_cells], of surfaces that are not regular
  std::vector<std::size_t> first_;    // [n_cells + 1]
  std::vector<std::uint32_t> listed_;  // cells that each blends with
};

}  // namespace dim
