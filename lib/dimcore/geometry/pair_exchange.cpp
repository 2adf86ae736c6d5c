#include "geometry/pair_exchange.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dim {
namespace {

struct Edge {
  Vec3 from{0.0};
  Vec3 along{0.0};  // unit
  double length_m = 0.0;

  Vec3 at(double s) const { return from + s * along; }
  Vec3 middle() const { return at(length_m / 2.0); }
};

struct Node {
  double x, weight;  // on [0, 1]
};

// Gauss-Legendre rules of 3, 5 and 8 points (Abramowitz & Stegun table 25.4), moved to [0, 1].
constexpr std::array<Node, 3> kGauss3 = {{{0.1127016653792583, 0.2777777777777778},
                                          {0.5, 0.4444444444444444},
                                          {0.8872983346207417, 0.2777777777777778}}};
constexpr std::array<Node, 5> kGauss5 = {{{0.0469100770306680, 0.1184634425280945},
                                          {0.2307653449471585, 0.2393143352496833},
                                          {0.5, 0.2844444444444444},
                                          {0.7692346550528415, 0.2393143352496833},
                                          {0.9530899229693320, 0.1184634425280945}}};
constexpr std::array<Node, 8> kGauss8 = {{{0.0198550717512319, 0.0506142681451881},
                                          {0.1016667612931866, 0.1111905172266872},
                                          {0.2372337950418355, 0.1568533229389437},
                                          {0.4082826787521751, 0.1813418916891810},
                                          {0.5917173212478249, 0.1813418916891810},
                                          {0.7627662049581645, 0.1568533229389437},
                                          {0.8983332387068134, 0.1111905172266872},
                                          {0.9801449282487681, 0.0506142681451881}}};

// Mean of ln r over two edges far apart.
template <std::size_t N>
double mean_log_apart(const Edge& e, const Edge& f, const std::array<Node, N>& rule) {
  double sum = 0.0;
  for (const auto& [x, wx] : rule) {
    const Vec3 p = e.at(x * e.length_m);
    double inner = 0.0;
    for (const auto& [y, wy] : rule) {
      const Vec3 d = f.at(y * f.length_m) - p;
      inner += wy * std::log(glm::dot(d, d));
    }
    sum += wx * inner;
  }
  return sum / 2.0;
}

// The second integral of ln sqrt(x² + d²) over x.
double twice_integrated_log(double x, double d) {
  const double r2 = x * x + d * d;
  if (r2 == 0.0) return 0.0;
  return (x * x - d * d) * std::log(r2) / 4.0 + d * x * std::atan2(x, d) - 0.75 * x * x;
}

// Double integral of ln r over edges along one direction, a distance apart.
double integral_parallel(const Edge& e, const Edge& f) {
  const Vec3 gap = f.from - e.from;
  const double offset = glm::dot(gap, e.along);
  const double d = glm::length(gap - offset * e.along);
  const double other = offset + glm::dot(f.along, e.along) * f.length_m;
  const double low = std::min(offset, other), high = std::max(offset, other);
  return twice_integrated_log(high, d) - twice_integrated_log(low, d) -
         twice_integrated_log(high - e.length_m, d) + twice_integrated_log(low - e.length_m, d);
}

// Integral of ln r from a point along an edge.
double integral_from_point(const Vec3& p, const Edge& f) {
  const Vec3 to = f.from - p;
  const double x0 = glm::dot(to, f.along), x1 = x0 + f.length_m;
  const double d = glm::length(to - x0 * f.along);
  const auto integrated = [d](double x) {
    const double r2 = x * x + d * d;
    return r2 > 0.0 ? x * std::log(r2) / 2.0 + d * std::atan2(x, d) : 0.0;
  };
  return integrated(x1) - integrated(x0) - f.length_m;
}

double distance_m(const Vec3& p, const Edge& f) {
  const double s = std::clamp(glm::dot(p - f.from, f.along), 0.0, f.length_m);
  return glm::length(f.at(s) - p);
}

// Double integral of ln r over skew edges, halved until each part of `e` is no longer than its distance.
double integral_skew(const Edge& e, const Edge& f, int depth) {
  constexpr int kDeepest = 10;
  if (depth < kDeepest && distance_m(e.middle(), f) < 1.5 * e.length_m) {
    const double half = e.length_m / 2.0;
    return integral_skew({e.from, e.along, half}, f, depth + 1) +
           integral_skew({e.at(half), e.along, half}, f, depth + 1);
  }
  double sum = 0.0;
  for (const auto& [x, weight] : kGauss8) sum += weight * integral_from_point(e.at(x * e.length_m), f);
  return sum * e.length_m;
}

double edge_term(const Edge& e, const Edge& f) {
  constexpr double kPerpendicular = 1e-12;
  constexpr double kParallel = 1e-6;
  const double cosine = glm::dot(e.along, f.along);
  if (std::abs(cosine) < kPerpendicular) return 0.0;
  const double longer = std::max(e.length_m, f.length_m);
  const double apart = glm::length(f.middle() - e.middle()) - (e.length_m + f.length_m) / 2.0;
  const double area = e.length_m * f.length_m;
  if (apart > 4.0 * longer) return cosine * area * mean_log_apart(e, f, kGauss3);
  if (apart > longer) return cosine * area * mean_log_apart(e, f, kGauss5);
  if (glm::length(glm::cross(e.along, f.along)) < kParallel) return cosine * integral_parallel(e, f);
  return cosine * integral_skew(e, f, 0);
}

std::vector<Edge> edges_of(const std::vector<Ring3>& rings, const Vec3& origin) {
  std::vector<Edge> edges;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 from = ring[i] - origin;
      const Vec3 step = ring[(i + 1) % ring.size()] - ring[i];
      const double length_m = glm::length(step);
      if (length_m > 0.0) edges.push_back({from, step / length_m, length_m});
    }
  }
  return edges;
}

}  // namespace

double pair_exchange_m2(const std::vector<Ring3>& a, const std::vector<Ring3>& b) {
  if (a.empty() || b.empty()) return 0.0;
  // Lengths are measured in the distance of the two: ln r is then small and its sum loses fewer digits.
  auto edges_a = edges_of(a, a[0][0]), edges_b = edges_of(b, a[0][0]);
  double scale_m = 0.0;
  for (const auto& e : edges_a) scale_m += e.length_m / static_cast<double>(edges_a.size());
  for (const auto& f : edges_b) scale_m = std::max(scale_m, glm::length(f.from));
  if (!(scale_m > 0.0)) return 0.0;
  for (auto* edges : {&edges_a, &edges_b}) {
    for (auto& e : *edges) e = {e.from / scale_m, e.along, e.length_m / scale_m};
  }
  double sum = 0.0;
  for (const auto& e : edges_a) {
    for (const auto& f : edges_b) sum += edge_term(e, f);
  }
  return std::max(0.0, sum / (2.0 * kPi)) * scale_m * scale_m;
}

std::vector<Ring3> front_part(const std::vector<Ring3>& rings, const Frame& plane, double tolerance_m) {
  std::vector<Ring3> result;
  bool any = false;
  for (const auto& ring : rings) {
    Ring3 kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3& p = ring[i];
      const Vec3& q = ring[(i + 1) % ring.size()];
      const double hp = plane.height(p), hq = plane.height(q);
      if (hp >= -tolerance_m) kept.push_back(p);
      if ((hp > tolerance_m && hq < -tolerance_m) || (hp < -tolerance_m && hq > tolerance_m))
        kept.push_back(p + (hp / (hp - hq)) * (q - p));
      any = any || hp > tolerance_m;
    }
    if (kept.size() >= 3) result.push_back(std::move(kept));
  }
  return any ? result : std::vector<Ring3>{};
}

}  // namespace dim
