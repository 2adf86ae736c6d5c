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
// crossings: for each end held fast the map to the crossing keeps straight lines straight. On which side of an
// edge a crossing lies is linear in both ends, each weighted by the other's height: no division is needed.
ShadowPlates::Cover ShadowPlates::region_cover(const Shadowing& plate, const ConvexRing& a,
                                               const ConvexRing& b) const {
  constexpr std::size_t kMost = ConvexRing::kMostCorners;
  std::array<Vec3, kMost> of_a, of_b;
  for (int i = 0; i < a.size(); ++i) of_a[static_cast<std::size_t>(i)] = plate.local(a[i]);
  for (int i = 0; i < b.size(); ++i) of_b[static_cast<std::size_t>(i)] = plate.local(b[i]);
  const auto n_a = static_cast<std::size_t>(a.size()), n_b = static_cast<std::size_t>(b.size());
  for (std::size_t i = 0; i < n_a; ++i) {
    for (std::size_t k = 0; k < n_b; ++k) {
      if (std::abs(of_a[i].z - of_b[k].z) <= tolerance_m_) return Cover::part;
    }
  }
  // All crossings beyond an edge: none. @param distance  of a point from the edge, inwards
  bool whole = true, touches = false;
  const auto beyond = [&](auto&& distance, double limit_m) {
    bool all_out = true, all_out_or_on = true;
    for (std::size_t i = 0; i < n_a; ++i) {
      const double da = distance(of_a[i]), ha = std::abs(of_a[i].z);
      for (std::size_t k = 0; k < n_b; ++k) {
        const double hb = std::abs(of_b[k].z), limit = limit_m * (ha + hb);
        const double inside = da * hb + distance(of_b[k]) * ha;
        all_out = all_out && inside < -limit;
        all_out_or_on = all_out_or_on && inside <= limit;
        whole = whole && inside >= -limit;
      }
    }
    touches = touches || (all_out_or_on && !all_out);
    return all_out;
  };
  const double tol = tolerance_m_, w = plate.size_m.x, h = plate.size_m.y;
  if (beyond([](const Vec3& p) { return p.x; }, tol) || beyond([](const Vec3& p) { return p.y; }, tol) ||
      beyond([&](const Vec3& p) { return w - p.x; }, tol) || beyond([&](const Vec3& p) { return h - p.y; }, tol))
    return Cover::none;
  // Along an edge a region with any extent is out; one without may lie on the very edge.
  if (touches && !(whole && n_a == 1 && n_b == 1)) return Cover::none;
  if (plate.rectangle) return whole ? Cover::whole : Cover::part;
  if (!plate.convex) return Cover::part;
  const auto& ring = plate.polygon->rings().front();
  whole = true;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 edge = ring[i] - ring[j];
    if (beyond([&](const Vec3& p) { return cross2(edge, Vec2(p.x, p.y) - ring[j]); }, tol * glm::length(edge)))
      return Cover::none;
  }
  return whole ? Cover::whole : Cover::part;
}

// A point of the segment is hidden where its sight line crosses the plate's plane inwards of every edge. In
// heights and distances from edges this is linear along the segment: h D(eye) + |h(eye)| D(point) >= 0.
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
  const double he = std::abs(h), tol = tolerance_m_;
  double low = 0.0, high = 1.0;
  // Keeps the part where what is linear along the segment is not negative.
  const auto keep = [&](double at_a, double at_b) {
    if (at_a < 0.0) {
      if (at_b < 0.0) return false;
      low = std::max(low, at_a / (at_a - at_b));
    } else if (at_b < 0.0) {
      high = std::min(high, at_a / (at_a - at_b));
    }
    return high > low;
  };
  const auto keep_inwards = [&](double of_eye, double of_a, double of_b) {
    return keep(ha * of_eye + he * of_a, hb * of_eye + he * of_b);
  };
  if (!keep(ha, hb)) return;
  const double ue = glm::dot(plate.u, eye) - plate.u0, ua = glm::dot(plate.u, a) - plate.u0,
               ub = glm::dot(plate.u, b) - plate.u0, w = plate.size_m.x + tol;
  if (!keep_inwards(ue + tol, ua + tol, ub + tol) || !keep_inwards(w - ue, w - ua, w - ub)) return;
  const double ve = glm::dot(plate.v, eye) - plate.v0, va = glm::dot(plate.v, a) - plate.v0,
               vb = glm::dot(plate.v, b) - plate.v0, height = plate.size_m.y + tol;
  if (!keep_inwards(ve + tol, va + tol, vb + tol) || !keep_inwards(height - ve, height - va, height - vb)) return;
  if (plate.rectangle) return hidden.add(low, high);
  const Vec2 on_eye(ue, ve), on_a(ua, va), on_b(ub, vb);
  if (!plate.convex) return add_outline(plate, on_eye, he, on_a, ha, on_b, hb, low, high, hidden);
  const auto& ring = plate.polygon->rings().front();
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 edge = ring[i] - ring[j];
    const double slack = tol * glm::length(edge);
    const auto inwards = [&](const Vec2& p) { return cross2(edge, p - ring[j]) + slack; };
    if (!keep_inwards(inwards(on_eye), inwards(on_a), inwards(on_b))) return;
  }
  hidden.add(low, high);
}

// Any outline: the segment is cut wherever its sight line crosses an edge, and between cuts it is hidden or not
// as a whole (even-odd).
void ShadowPlates::add_outline(const Shadowing& plate, const Vec2& eye, double he, const Vec2& a, double ha,
                               const Vec2& b, double hb, double low, double high, Intervals& hidden) const {
  const auto crossing = [&](double s) {
    const double h = std::max(0.0, ha + s * (hb - ha));
    return (h * eye + he * (a + s * (b - a))) / (h + he);
  };
  const Vec2 from = crossing(low), along = crossing(high) - from;
  if (glm::dot(along, along) <= tolerance_m_ * tolerance_m_) {
    if (plate.polygon->contains(from, tolerance_m_)) hidden.add(low, high);
    return;
  }
  constexpr std::size_t kFew = 64;
  std::array<double, kFew> few;
  std::vector<double> many;
  std::size_t n = 0;
  for (const auto& ring : plate.polygon->rings()) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double gi = cross2(along, ring[i] - from), gj = cross2(along, ring[j] - from);
      if ((gi < 0.0) == (gj < 0.0)) continue;
      // Where on the segment the sight line passes through the edge's line.
      const Vec2 edge = ring[i] - ring[j];
      const double of_eye = cross2(edge, eye - ring[j]);
      const double at_a = ha * of_eye + he * cross2(edge, a - ring[j]);
      const double at_b = hb * of_eye + he * cross2(edge, b - ring[j]);
      if (at_a == at_b) continue;
      const double s = at_a / (at_a - at_b);
      if (n < kFew)
        few[n] = s;
      else if (n == kFew)
        many.assign(few.begin(), few.end());
      if (n >= kFew) many.push_back(s);
      ++n;
    }
  }
  double* cuts = many.empty() ? few.data() : many.data();
  std::sort(cuts, cuts + n);
  for (std::size_t k = 0; k + 1 < n; k += 2) hidden.add(std::max(low, cuts[k]), std::min(high, cuts[k + 1]));
}

}  // namespace dim
