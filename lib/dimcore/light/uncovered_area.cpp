#include "light/uncovered_area.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shadow_plates.hpp"

namespace dim {
namespace {

constexpr int kLines = 48;
// Lines run aslant: edges of buildings are level or upright more often than not.
constexpr double kSlant_rad = 0.6180339887;

Vec2 turned(const Vec2& p) {
  static const double cosine = std::cos(kSlant_rad), sine = std::sin(kSlant_rad);
  return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x};
}

// Where a line of height y crosses a closed ring.
void add_crossings(std::span<const Vec2> ring, double y, std::vector<double>& crossings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
    if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
}

}  // namespace

void ConvexPatch::keep(double a, double b, double c) {
  std::array<Vec2, kMostCorners> before;
  const std::size_t n = n_;
  std::copy_n(corner_.begin(), n, before.begin());
  n_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &p = before[i], &q = before[i + 1 < n ? i + 1 : 0];
    const double at_p = a + b * p.x + c * p.y, at_q = a + b * q.x + c * q.y;
    if (at_p >= 0.0) add(p);
    if ((at_p >= 0.0) != (at_q >= 0.0)) add(p + at_p / (at_p - at_q) * (q - p));
  }
}

double ConvexPatch::area() const {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < n_; ++i) {
    const Vec2 a = corner_[i] - corner_[0], b = corner_[i + 1] - corner_[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

Vec2 ConvexPatch::centroid() const {
  double twice = 0.0;
  Vec2 sum(0.0);
  for (std::size_t i = 1; i + 1 < n_; ++i) {
    const Vec2 a = corner_[i] - corner_[0], b = corner_[i + 1] - corner_[0];
    const double triangle = a.x * b.y - a.y * b.x;
    twice += triangle;
    sum += triangle / 3.0 * (a + b);
  }
  return twice != 0.0 ? corner_[0] + sum / twice : corner_[0];
}

double uncovered_area(const ConvexPatch& patch, const std::vector<CoverRings>& covers) {
  if (patch.empty()) return 0.0;
  if (covers.empty()) return patch.area();
  std::vector<Vec2> outline;
  for (const Vec2& p : patch.corners()) outline.push_back(turned(p));
  const auto [low, high] =
      std::minmax_element(outline.begin(), outline.end(), [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
  std::vector<CoverRings> above;
  for (CoverRings rings : covers) {
    bool below = true, beyond = true;
    for (auto& ring : rings) {
      for (Vec2& p : ring) {
        p = turned(p);
        below = below && p.y < low->y;
        beyond = beyond && p.y > high->y;
      }
    }
    if (!below && !beyond) above.push_back(std::move(rings));
  }
  if (above.empty()) return patch.area();
  const double step = (high->y - low->y) / kLines;
  double whole = 0.0, open = 0.0;
  std::vector<double> ends, crossings;
  Intervals hidden;
  for (int line = 0; line < kLines; ++line) {
    const double y = low->y + (line + 0.5) * step;
    ends.clear();
    add_crossings(outline, y, ends);
    if (ends.size() < 2) continue;
    const double from = std::min(ends[0], ends[1]), length = std::abs(ends[1] - ends[0]);
    hidden.clear();
    for (const auto& rings : above) {
      crossings.clear();
      for (const auto& ring : rings) add_crossings(ring, y, crossings);
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        hidden.add(std::clamp((crossings[i] - from) / length, 0.0, 1.0),
                   std::clamp((crossings[i + 1] - from) / length, 0.0, 1.0));
    }
    hidden.merge();
    double covered = 0.0;
    for (const auto& part : hidden.parts()) covered += part.high - part.low;
    whole += length;
    open += length * (1.0 - covered);
  }
  return whole > 0.0 ? patch.area() * open / whole : 0.0;
}

}  // namespace dim
