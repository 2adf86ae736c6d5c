#include "geometry/area_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kNoArea = 1e-14;  // of the bounding rectangle

std::vector<double> heights(const std::vector<Ring2>& rings) {
  std::vector<double> y;
  for (const auto& ring : rings) {
    for (const auto& p : ring) y.push_back(p.y);
  }
  std::sort(y.begin(), y.end());
  y.erase(std::unique(y.begin(), y.end()), y.end());
  return y;
}

struct Crossing {
  double middle, low, high;  // x where an edge crosses the slab's middle, lower and upper limit
};

std::vector<Crossing> crossings(const std::vector<Ring2>& rings, double y0, double y1) {
  std::vector<Crossing> result;
  const double middle = (y0 + y1) / 2.0;
  for (const auto& ring : rings) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2& a = ring[i];
      const Vec2& b = ring[j];
      if ((a.y > middle) == (b.y > middle)) continue;
      const auto at = [&](double y) { return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)); };
      result.push_back({at(middle), at(y0), at(y1)});
    }
  }
  std::sort(result.begin(), result.end(), [](const auto& p, const auto& q) { return p.middle < q.middle; });
  return result;
}

}  // namespace

AreaSampler::AreaSampler(const std::vector<Ring2>& rings) {
  const auto y = heights(rings);
  double low = 0.0, high = 0.0, total = 0.0;
  for (const auto& ring : rings) {
    for (const auto& p : ring) {
      low = std::min(low, p.x - rings[0][0].x);
      high = std::max(high, p.x - rings[0][0].x);
    }
  }
  const double ignored = y.empty() ? 0.0 : kNoArea * (high - low) * (y.back() - y.front());
  for (std::size_t slab = 0; slab + 1 < y.size(); ++slab) {
    const auto across = crossings(rings, y[slab], y[slab + 1]);
    for (std::size_t k = 0; k + 1 < across.size(); k += 2) {
      const auto& l = across[k];
      const auto& r = across[k + 1];
      const double area = (r.middle - l.middle) * (y[slab + 1] - y[slab]);
      if (!(area > ignored)) continue;
      trapezoids_.push_back({y[slab], y[slab + 1], l.low, r.low, l.high, r.high});
      cumulative_.push_back(total += area);
    }
  }
}

Vec2 AreaSampler::point(double a, double b) const {
  std::size_t k = 0;
  if (trapezoids_.size() > 1) {
    const double wanted = a * cumulative_.back();
    k = static_cast<std::size_t>(std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, wanted) -
                                 cumulative_.begin());
    const double before = k > 0 ? cumulative_[k - 1] : 0.0;
    a = std::clamp((wanted - before) / (cumulative_[k] - before), 0.0, 1.0);
  }
  const auto& t = trapezoids_[k];
  const double w0 = t.x1 - t.x0, w1 = t.x1_top - t.x0_top;
  // The area below height s of the unit-high trapezoid is w0 s + (w1 - w0) s^2 / 2; solved for s without
  // cancellation.
  const double root = std::sqrt(std::max(0.0, w0 * w0 + a * (w1 * w1 - w0 * w0)));
  const double s = w0 + root > 0.0 ? a * (w0 + w1) / (w0 + root) : a;
  const double left = t.x0 + s * (t.x0_top - t.x0), right = t.x1 + s * (t.x1_top - t.x1);
  return {left + b * (right - left), t.y0 + s * (t.y1 - t.y0)};
}

std::vector<std::array<Vec2, 3>> AreaSampler::triangles() const {
  std::vector<std::array<Vec2, 3>> result;
  for (const auto& t : trapezoids_) {
    const Vec2 a(t.x0, t.y0), b(t.x1, t.y0), c(t.x1_top, t.y1), d(t.x0_top, t.y1);
    if (t.x1 > t.x0) result.push_back({a, b, c});
    if (t.x1_top > t.x0_top) result.push_back({a, c, d});
  }
  return result;
}

}  // namespace dim
