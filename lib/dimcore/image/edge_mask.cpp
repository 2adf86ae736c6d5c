#include "image/edge_mask.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kSlack_px = 0.05;  // for rounding, and polygons widened by the ray caster's tolerance

}  // namespace

EdgeMask::EdgeMask(int width, int height)
    : width_(width), height_(height), marked_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false) {}

// Pixels of one column (of one row, where steep) between two heights.
void EdgeMask::mark(double along, double from, double to, bool steep) {
  const int n = steep ? width_ : height_;
  const int low = std::max(0, static_cast<int>(std::floor(from - kSlack_px)));
  const int high = std::min(n - 1, static_cast<int>(std::floor(to + kSlack_px)));
  const int at = static_cast<int>(along);
  for (int i = low; i <= high; ++i) marked_[steep ? index(i, at) : index(at, i)] = true;
}

void EdgeMask::add(const Vec2& a, const Vec2& b) {
  Vec2 p = a, q = b;
  const bool steep = std::abs(q.y - p.y) > std::abs(q.x - p.x);
  if (steep) std::swap(p.x, p.y), std::swap(q.x, q.y);
  if (p.x > q.x) std::swap(p, q);
  const double slope = q.x > p.x ? (q.y - p.y) / (q.x - p.x) : 0.0;
  const int n = steep ? height_ : width_;
  const int first = std::max(0, static_cast<int>(std::floor(p.x - kSlack_px)));
  const int last = std::min(n - 1, static_cast<int>(std::floor(q.x + kSlack_px)));
  for (int i = first; i <= last; ++i) {
    const double y0 = p.y + slope * (std::clamp(i - kSlack_px, p.x, q.x) - p.x);
    const double y1 = p.y + slope * (std::clamp(i + 1 + kSlack_px, p.x, q.x) - p.x);
    mark(i, std::min(y0, y1), std::max(y0, y1), steep);
  }
}

}  // namespace dim
