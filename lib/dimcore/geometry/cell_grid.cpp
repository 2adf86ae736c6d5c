#include "geometry/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr double kEmptyFraction = 1e-13;

std::vector<Ring2> clip_strip(const std::vector<Ring2>& rings, int axis, double low, double high) {
  std::vector<Ring2> result;
  for (const auto& ring : rings) {
    Ring2 clipped = clip_half_plane(clip_half_plane(ring, axis, high, 1.0), axis, low, -1.0);
    if (clipped.size() >= 3) result.push_back(std::move(clipped));
  }
  return result;
}

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

// Sutherland & Hodgman 1974, one plane.
Ring2 clip_half_plane(const Ring2& ring, int axis, double limit, double sign) {
  Ring2 result;
  const auto depth = [&](const Vec2& p) { return sign * (limit - p[axis]); };
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const double from = depth(ring[j]), to = depth(ring[i]);
    if ((from < 0.0) != (to < 0.0)) {
      Vec2 crossing = ring[j] + (from / (from - to)) * (ring[i] - ring[j]);
      crossing[axis] = limit;
      result.push_back(crossing);
    }
    if (to >= 0.0) result.push_back(ring[i]);
  }
  return result;
}

CellGrid::CellGrid(const Polygon& polygon, double cell_m, std::optional<std::pair<int, int>> grid) {
  const Vec2 size = polygon.size_m();
  nu_ = grid ? grid->first : n_steps(size.x, cell_m);
  nv_ = grid ? grid->second : n_steps(size.y, cell_m);
  if (nu_ < 1 || nv_ < 1 || static_cast<double>(nu_) * nv_ > kMaxSquares)
    throw LimitError("a grid of " + std::to_string(nu_) + " x " + std::to_string(nv_) +
                     " squares on one surface; use a larger --cell");
  step_m_ = {size.x / nu_, size.y / nv_};
  per_m_ = {nu_ / size.x, nv_ / size.y};
  regular_ = polygon.is_rectangle();
  clip(polygon);
}

void CellGrid::clip(const Polygon& polygon) {
  const auto edge = [](int i, int n, double size) { return i == n ? size : size * i / n; };
  const Vec2 size = polygon.size_m();
  if (!regular_) cell_of_square_.assign(static_cast<std::size_t>(nu_) * static_cast<std::size_t>(nv_), -1);
  for (int j = 0; j < nv_; ++j) {
    const double y0 = edge(j, nv_, size.y), y1 = edge(j + 1, nv_, size.y);
    const auto row = regular_ ? std::vector<Ring2>{} : clip_strip(polygon.rings(), 1, y0, y1);
    for (int i = 0; i < nu_; ++i) {
      GridCell cell;
      cell.low = {edge(i, nu_, size.x), y0};
      cell.high = {edge(i + 1, nu_, size.x), y1};
      const double square_m2 = (cell.high.x - cell.low.x) * (cell.high.y - cell.low.y);
      cell.centroid = (cell.low + cell.high) / 2.0;
      cell.area_m2 = square_m2;
      if (!regular_) {
        double area = 0.0, mx = 0.0, my = 0.0;
        for (const auto& ring : clip_strip(row, 0, cell.low.x, cell.high.x)) {
          const auto moments = area_moments(ring);
          area += moments[0];
          mx += moments[1];
          my += moments[2];
        }
        if (area <= kEmptyFraction * square_m2) continue;
        cell.area_m2 = area;
        cell.centroid = {mx / area, my / area};
        cell.whole = area >= square_m2 * (1.0 - 1e-12);
        cell_of_square_[static_cast<std::size_t>(j * nu_ + i)] = static_cast<std::int32_t>(cells_.size());
      }
      cells_.push_back(cell);
    }
  }
  if (!regular_) fill_empty_squares();
}

void CellGrid::fill_empty_squares() {
  empty_.resize(cell_of_square_.size());
  std::deque<int> front;
  for (std::size_t s = 0; s < cell_of_square_.size(); ++s) {
    empty_[s] = cell_of_square_[s] < 0;
    if (!empty_[s]) front.push_back(static_cast<int>(s));
  }
  while (!front.empty()) {
    const int square = front.front();
    front.pop_front();
    const int i = square % nu_, j = square / nu_;
    const auto visit = [&](int ni, int nj) {
      if (ni < 0 || nj < 0 || ni >= nu_ || nj >= nv_) return;
      auto& neighbour = cell_of_square_[static_cast<std::size_t>(nj * nu_ + ni)];
      if (neighbour >= 0) return;
      neighbour = cell_of_square_[static_cast<std::size_t>(square)];
      front.push_back(nj * nu_ + ni);
    };
    visit(i - 1, j);
    visit(i + 1, j);
    visit(i, j - 1);
    visit(i, j + 1);
  }
}

int CellGrid::cell_of_square(int i, int j) const {
  if (i < 0 || j < 0 || i >= nu_ || j >= nv_) return -1;
  const auto square = static_cast<std::size_t>(j * nu_ + i);
  if (regular_) return static_cast<int>(square);
  return empty_[square] ? -1 : cell_of_square_[square];
}

}  // namespace dim
