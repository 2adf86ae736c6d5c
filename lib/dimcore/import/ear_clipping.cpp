#include "import/ear_clipping.hpp"

#include <numeric>

#include "geometry/segment.hpp"

namespace dim {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

bool within(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> ear_triangles(const Ring2& ring) {
  std::vector<std::size_t> left(ring.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<std::array<std::size_t, 3>> triangles;
  const auto is_ear = [&](std::size_t k) {
    const std::size_t n = left.size();
    const Vec2 &a = ring[left[(k + n - 1) % n]], &b = ring[left[k]], &c = ring[left[(k + 1) % n]];
    if (turn(a, b, c) <= 0.0) return false;
    for (const std::size_t i : left)
      if (within(ring[i], a, b, c)) return false;
    return true;
  };
  std::size_t k = 0, n_tried = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    // Once round without an ear: a ring that crosses itself or has corners on one line. Any corner will do.
    if (n_tried < n && !is_ear(k % n)) {
      ++k, ++n_tried;
      continue;
    }
    k %= n;
    triangles.push_back({left[(k + n - 1) % n], left[k], left[(k + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    n_tried = 0;
  }
  if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace dim
