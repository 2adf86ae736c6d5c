#include "geometry/shadow_plates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dim {
namespace {

constexpr int kPlatesPerLeaf = 4;
constexpr double kCrack = 1e-7;  // of a segment: two plates that nearly touch are taken to touch

double cross2(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

bool is_convex(const Polygon& polygon) {
  if (polygon.rings().size() != 1) return false;
  const auto& ring = polygon.rings().front();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()], &c = ring[(i + 2) % ring.size()];
    if (cross2(b - a, c - b) < 0.0) return false;
  }
  return true;
}

}  // namespace

void Intervals::merge() {
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.low < b.low; });
  std::size_t n = 0;
  for (const Part& part : parts_) {
    if (n > 0 && part.low <= parts_[n - 1].high + kCrack)
      parts_[n - 1].high = std::max(parts_[n - 1].high, part.high);
    else
      parts_[n++] = part;
  }
  parts_.resize(n);
  if (n > 0 && parts_.front().low <= kCrack) parts_.front().low = 0.0;
  if (n > 0 && parts_.back().high >= 1.0 - kCrack) parts_.back().high = 1.0;
}

ShadowPlates::ShadowPlates(const std::vector<Plate>& plates, double diameter_m)
    : tolerance_m_(1e-9 * diameter_m), order_(plates.size()) {
  for (const auto& plate : plates) {
    const auto& frame = plate.polygon->frame();
    Shadowing s{frame.n, frame.u, frame.v, glm::dot(frame.n, frame.origin), glm::dot(frame.u, frame.origin),
                glm::dot(frame.v, frame.origin), plate.polygon->size_m(), plate.polygon,
                plate.polygon->is_rectangle() || plate.fills_rectangle, false, plate.open_back,
                Vec3(std::numeric_limits<double>::max()), Vec3(std::numeric_limits<double>::lowest())};
    s.convex = s.rectangle || is_convex(*plate.polygon);
    const auto reach = [&](const Vec2& p) {
      s.low = glm::min(s.low, frame.to_world(p));
      s.high = glm::max(s.high, frame.to_world(p));
    };
    for (const auto& ring : plate.polygon->rings()) {
      for (const auto& p : ring) reach(p);
    }
    if (s.rectangle) {
      for (const Vec2& p : {Vec2(0.0), Vec2(s.size_m.x, 0.0), s.size_m, Vec2(0.0, s.size_m.y)}) reach(p);
    }
    plates_.push_back(s);
  }
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

int ShadowPlates::build(int first, int last) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({Vec3(std::numeric_limits<double>::max()), Vec3(std::numeric_limits<double>::lowest()), first,
                    last - first});
  const auto plate = [&](int at) -> const Shadowing& {
    return plates_[static_cast<std::size_t>(order_[static_cast<std::size_t>(at)])];
  };
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  Vec3 middle_low = low, middle_high = high;
  for (int at = first; at < last; ++at) {
    low = glm::min(low, plate(at).low);
    high = glm::max(high, plate(at).high);
    middle_low = glm::min(middle_low, plate(at).low + plate(at).high);
    middle_high = glm::max(middle_high, plate(at).low + plate(at).high);
  }
  nodes_.back().low = low;
  nodes_.back().high = high;
  if (last - first <= kPlatesPerLeaf) return index;
  const Vec3 spread = middle_high - middle_low;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : (spread.y >= spread.z ? 1 : 2);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
    const auto &pa = plates_[static_cast<std::size_t>(a)], &pb = plates_[static_cast<std::size_t>(b)];
    const double ma = pa.low[axis] + pa.high[axis], mb = pb.low[axis] + pb.high[axis];
    return ma < mb || (ma == mb && a < b);
  });
  build(first, middle);
  const int second = build(middle, last);
  nodes_[static_cast<std::size_t>(index)].first = second;
  nodes_[static_cast<std::size_t>(index)].count = 0;
  return index;
}

void ShadowPlates::candidates(const Shaft& shaft, std::vector<int>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  std::array<int, 64> stack;
  int depth = 0;
  stack[0] = 0;
  while (depth >= 0) {
    const int index = stack[static_cast<std::size_t>(depth--)];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (shaft.misses(node.low, node.high, tolerance_m_)) continue;
    if (node.count == 0) {
      stack[static_cast<std::size_t>(++depth)] = node.first;
      stack[static_cast<std::size_t>(++depth)] = index + 1;
      continue;
    }
    for (int at = node.first; at < node.first + node.count; ++at) {
      const int plate = order_[static_cast<std::size_t>(at)];
      const auto& s = plates_[static_cast<std::size_t>(plate)];
      if (!shaft.misses(s.low, s.high, tolerance_m_) && cover(plate, shaft) != Cover::none)
        found.push_back(plate);
    }
  }
  std::sort(found.begin(), found.end());
}

Vec2 ShadowPlates::crossing(const Shadowing& plate, const Vec3& p, double hp, const Vec3& q, double hq) const {
  const double t = hp / (hp - hq);
  const Vec3 at = p + t * (q - p);
  return {glm::dot(plate.u, at) - plate.u0, glm::dot(plate.v, at) - plate.v0};
}

double ShadowPlates::crossing_share(int index, const Vec3& p, const Vec3& q) const {
  const Shadowing& plate = plates_[static_cast<std::size_t>(index)];
  const double hp = glm::dot(plate.n, p) - plate.n0, hq = glm::dot(plate.n, q) - plate.n0;
  const bool crossed = hp * hq < 0.0 && std::min(std::abs(hp), std::abs(hq)) > tolerance_m_;
  return crossed ? hp / (hp - hq) : 0.5;
}

ShadowPlates::Cover ShadowPlates::cover(int index, const Shaft& shaft) const {
  if (index == shaft.skip()) return Cover::none;
  const Shadowing& plate = plates_[static_cast<std::size_t>(index)];
  const auto heights = [&](const ConvexRing& ring) {
    Vec2 range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
    for (const Vec3& corner : ring) {
      const double height = glm::dot(plate.n, corner) - plate.n0;
      range = {std::min(range.x, height), std::max(range.y, height)};
    }
    return range;
  };
  const Vec2 a = heights(shaft.a()), b = heights(shaft.b());
  const double tol = tolerance_m_;
  if ((a.x >= -tol && b.x >= -tol) || (a.y <= tol && b.y <= tol)) return Cover::none;
  if (plate.open_back && a.y <= tol) return Cover::none;
  const bool a_front = a.x >= -tol, a_back = a.y <= tol, b_front = b.x >= -tol, b_back = b.y <= tol;
  if (a_front && b_back) return region_cover(plate, shaft.a(), shaft.b());
  if (a_back && b_front) return region_cover(plate, shaft.a(), shaft.b());
  // The plane cuts one of the two: each half against the other's opposite half.
  const auto halves = [&](const ConvexRing& ring) {
    return std::array<ConvexRing, 2>{ring.front_of(plate.n, plate.n0), ring.front_of(-plate.n, -plate.n0)};
  };
  const auto of_a = halves(shaft.a()), of_b = halves(shaft.b());
  for (std::size_t side = 0; side < 2; ++side) {
    if (side == 1 && plate.open_back) continue;
    if (of_a[side].empty() || of_b[1 - side].empty()) continue;
    if (region_cover(plate, of_a[side], of_b[1 - side]) != Cover::none) return Cover::part;
  }
  return Cover::none;
}

// Lines from one convex ring to another on the other side of the plane cross it in the hull of the corners'
// crossings: for each end held fast the map to the crossing keeps straight lines straight.
ShadowPlates::Cover ShadowPlates::region_cover(const Shadowing& plate, const ConvexRing& a,
                                               const ConvexRing& b) const {
  std::array<Vec2, 512> region;
  std::size_t n = 0;
  Vec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Vec3& p : a) {
    const double hp = glm::dot(plate.n, p) - plate.n0;
    for (const Vec3& q : b) {
      const double hq = glm::dot(plate.n, q) - plate.n0;
      if (std::abs(hp - hq) <= tolerance_m_ || n == region.size()) return Cover::part;
      const Vec2 at = crossing(plate, p, hp, q, hq);
      region[n++] = at;
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  }
  const double tol = tolerance_m_;
  if (high.x <= tol || high.y <= tol || low.x >= plate.size_m.x - tol || low.y >= plate.size_m.y - tol) {
    // A region without extent may lie on the very edge.
    if (high.x < -tol || high.y < -tol || low.x > plate.size_m.x + tol || low.y > plate.size_m.y + tol ||
        high.x - low.x > tol || high.y - low.y > tol)
      return Cover::none;
  }
  if (plate.rectangle)
    return low.x >= -tol && low.y >= -tol && high.x <= plate.size_m.x + tol && high.y <= plate.size_m.y + tol
               ? Cover::whole
               : Cover::part;
  if (!plate.convex) return Cover::part;
  const auto& ring = plate.polygon->rings().front();
  bool whole = true;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 edge = ring[i] - ring[j];
    const double limit = tol * glm::length(edge);
    bool all_out = true;
    for (std::size_t k = 0; k < n; ++k) {
      const double side = cross2(edge, region[k] - ring[j]);
      all_out = all_out && side < -limit;
      whole = whole && side >= -limit;
    }
    if (all_out) return Cover::none;
  }
  return whole ? Cover::whole : Cover::part;
}

void ShadowPlates::add_hidden(int index, const Vec3& eye, const Vec3& a, const Vec3& b,
                              LooksFrom looks_from, Intervals& hidden) const {
  const Shadowing& plate = plates_[static_cast<std::size_t>(index)];
  const double h = glm::dot(plate.n, eye) - plate.n0;
  const bool from_behind = (h < 0.0) == (looks_from == LooksFrom::eye);
  if (std::abs(h) <= tolerance_m_ || (from_behind && plate.open_back)) return;
  // Heights towards the far side: positive beyond the plate's plane.
  const double sign = h > 0.0 ? -1.0 : 1.0;
  const double ha = sign * (glm::dot(plate.n, a) - plate.n0), hb = sign * (glm::dot(plate.n, b) - plate.n0);
  if (ha <= tolerance_m_ && hb <= tolerance_m_) return;
  double s0 = 0.0, s1 = 1.0;
  if (ha < 0.0) s0 = ha / (ha - hb);
  if (hb < 0.0) s1 = ha / (ha - hb);
  if (!(s1 > s0)) return;
  const double he = -std::abs(h);
  const auto at = [&](double s) { return a + s * (b - a); };
  const double h0 = ha + s0 * (hb - ha), h1 = ha + s1 * (hb - ha);
  add_crossed(plate, crossing(plate, eye, he, at(s0), std::max(h0, 0.0)),
              crossing(plate, eye, he, at(s1), std::max(h1, 0.0)), std::max(h0, 0.0) - he,
              std::max(h1, 0.0) - he, s0, s1, hidden);
}

// The sight line crosses the plate's plane along `from`..`to` while it runs over s0..s1 of the segment; w0, w1
// are the weights of the projective map between the two.
void ShadowPlates::add_crossed(const Shadowing& plate, const Vec2& from, const Vec2& to, double w0, double w1,
                               double s0, double s1, Intervals& hidden) const {
  const Vec2 along = to - from;
  const double tol = tolerance_m_;
  const auto add = [&](double u0, double u1) {
    const auto s = [&](double u) { return s0 + (s1 - s0) * (u * w0 / (w1 * (1.0 - u) + u * w0)); };
    if (u1 > u0) hidden.add(s(u0), s(u1));
  };
  if (glm::dot(along, along) <= tol * tol) {
    const bool inside = plate.rectangle ? from.x >= -tol && from.y >= -tol && from.x <= plate.size_m.x + tol &&
                                              from.y <= plate.size_m.y + tol
                                        : plate.polygon->contains(from, tol);
    if (inside) add(0.0, 1.0);
    return;
  }
  double low = 0.0, high = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double before = -tol - from[axis], behind = plate.size_m[axis] + tol - from[axis];
    if (along[axis] == 0.0) {
      if (before > 0.0 || behind < 0.0) return;
      continue;
    }
    const double t0 = before / along[axis], t1 = behind / along[axis];
    low = std::max(low, std::min(t0, t1));
    high = std::min(high, std::max(t0, t1));
  }
  if (!(high > low)) return;
  if (plate.rectangle) return add(low, high);
  // Even-odd along the whole line.
  std::array<double, 64> inline_cuts;
  std::vector<double> more_cuts;
  std::size_t n = 0;
  const double length2 = glm::dot(along, along);
  for (const auto& ring : plate.polygon->rings()) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double gi = cross2(along, ring[i] - from), gj = cross2(along, ring[j] - from);
      if ((gi < 0.0) == (gj < 0.0)) continue;
      const Vec2 cut = ring[j] + (gj / (gj - gi)) * (ring[i] - ring[j]);
      const double u = glm::dot(cut - from, along) / length2;
      if (n < inline_cuts.size())
        inline_cuts[n++] = u;
      else
        more_cuts.push_back(u);
    }
  }
  if (!more_cuts.empty()) {
    more_cuts.insert(more_cuts.end(), inline_cuts.begin(), inline_cuts.end());
    std::sort(more_cuts.begin(), more_cuts.end());
    for (std::size_t k = 0; k + 1 < more_cuts.size(); k += 2)
      add(std::max(0.0, more_cuts[k]), std::min(1.0, more_cuts[k + 1]));
    return;
  }
  std::sort(inline_cuts.begin(), inline_cuts.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t k = 0; k + 1 < n; k += 2)
    add(std::max(0.0, inline_cuts[k]), std::min(1.0, inline_cuts[k + 1]));
}

}  // namespace dim
