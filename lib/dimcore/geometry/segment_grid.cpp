#include "geometry/segment_grid.hpp"

#include <algorithm>
#include <cmath>

namespace dim {

SegmentGrid::SegmentGrid(int width, int height, std::size_t n_segments) {
  constexpr double kMostAcross = 512.0;
  const double across = std::clamp(2.0 * std::sqrt(static_cast<double>(n_segments)), 1.0, kMostAcross);
  square_px_ = std::max(width, height) / across;
  nx_ = static_cast<int>(width / square_px_) + 1;
  ny_ = static_cast<int>(height / square_px_) + 1;
  squares_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
}

// Row by row, the squares that the segment passes, widened a little so that rounding misses none.
template <class Function>
void SegmentGrid::for_squares(const Vec2& a, const Vec2& b, Function&& f) const {
  constexpr double kMargin = 1e-6;
  const auto index = [](double x, int n) { return std::clamp(static_cast<int>(std::floor(x)), 0, n - 1); };
  const Vec2 p = (a.y <= b.y ? a : b) / square_px_, q = (a.y <= b.y ? b : a) / square_px_;
  const int last_row = index(q.y + kMargin, ny_);
  for (int row = index(p.y - kMargin, ny_); row <= last_row; ++row) {
    double x0 = p.x, x1 = q.x;
    if (q.y > p.y) {
      const auto x_at = [&](double y) {
        return p.x + (q.x - p.x) * std::clamp((y - p.y) / (q.y - p.y), 0.0, 1.0);
      };
      x0 = x_at(row - kMargin);
      x1 = x_at(row + 1 + kMargin);
    }
    const int last = index(std::max(x0, x1) + kMargin, nx_);
    for (int column = index(std::min(x0, x1) - kMargin, nx_); column <= last; ++column)
      f(static_cast<std::size_t>(row) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(column));
  }
}

void SegmentGrid::add(std::uint32_t index, const Vec2& a, const Vec2& b) {
  for_squares(a, b, [&](std::size_t square) { squares_[square].push_back(index); });
}

void SegmentGrid::near(const Vec2& a, const Vec2& b, std::vector<std::uint32_t>& found) const {
  found.clear();
  for_squares(a, b, [&](std::size_t square) {
    found.insert(found.end(), squares_[square].begin(), squares_[square].end());
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace dim
