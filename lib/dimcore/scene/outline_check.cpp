#include "scene/outline_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "database/toml_reader.hpp"
#include "geometry/segment.hpp"

namespace dim {
namespace {

// Touching is judged at this fraction of the polygon's size.
constexpr double kTouch = 1e-10;

double extent(const Ring3& ring) {
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  return ring.empty() ? 0.0 : glm::length(high - low);
}

double length_around(const Ring3& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += glm::length(ring[(i + 1) % ring.size()] - ring[i]);
  return sum;
}

// Largest triangle that the first corner makes with an edge: tells an outline like an 8, whose parts cancel,
// from corners on one line.
double largest_corner_area(const Ring3& ring) {
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    largest = std::max(largest, glm::length(glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0])) / 2.0);
  return largest;
}

void drop_repeats(Ring3& ring) {
  const double same = 1e-12 * extent(ring);
  Ring3 kept;
  for (const auto& p : ring) {
    if (kept.empty() || glm::length(p - kept.back()) > same) kept.push_back(p);
  }
  while (kept.size() > 1 && glm::length(kept.front() - kept.back()) <= same) kept.pop_back();
  ring = std::move(kept);
}

struct Edge {
  Vec2 a, b;
  std::size_t ring, index, n;
  double low_x() const { return std::min(a.x, b.x); }
  double high_x() const { return std::max(a.x, b.x); }
};

double distance_to_edge(const Vec2& p, const Edge& e) {
  const Vec2 d = e.b - e.a;
  const double t = std::clamp(glm::dot(p - e.a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::length(p - e.a - t * d);
}

bool properly_cross(const Edge& e, const Edge& f) {
  const double s1 = cross(e.b - e.a, f.a - e.a), s2 = cross(e.b - e.a, f.b - e.a);
  const double s3 = cross(f.b - f.a, e.a - f.a), s4 = cross(f.b - f.a, e.b - f.a);
  return ((s1 > 0) != (s2 > 0)) && ((s3 > 0) != (s4 > 0));
}

bool meet(const Edge& e, const Edge& f, double touch) {
  if (std::max(e.a.y, e.b.y) + touch < std::min(f.a.y, f.b.y) ||
      std::max(f.a.y, f.b.y) + touch < std::min(e.a.y, e.b.y))
    return false;
  if (e.ring == f.ring && ((e.index + 1) % e.n == f.index || (f.index + 1) % e.n == e.index)) {
    // Neighbours share a corner; they may not run back over each other.
    const bool e_first = (e.index + 1) % e.n == f.index;
    const Edge &first = e_first ? e : f, &second = e_first ? f : e;
    const Vec2 u = first.a - first.b, v = second.b - second.a;
    if (glm::dot(u, v) <= 0.0) return false;
    return glm::length(u) < glm::length(v) ? distance_to_edge(first.a, second) <= touch
                                           : distance_to_edge(second.b, first) <= touch;
  }
  return properly_cross(e, f) || distance_to_edge(e.a, f) <= touch || distance_to_edge(e.b, f) <= touch ||
         distance_to_edge(f.a, e) <= touch || distance_to_edge(f.b, e) <= touch;
}

bool contains(const Ring2& ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

std::string ring_name(std::size_t ring) { return ring == 0 ? "outline" : fmt::format("hole {}", ring); }

std::string meeting_text(const Edge& e, const Edge& f) {
  if (e.ring == f.ring)
    return fmt::format("the {} crosses or touches itself: side {} meets side {}", ring_name(e.ring),
                       std::min(e.index, f.index) + 1, std::max(e.index, f.index) + 1);
  return fmt::format("{} crosses or touches {}", ring_name(std::max(e.ring, f.ring)),
                     e.ring == 0 || f.ring == 0 ? "the outline" : ring_name(std::min(e.ring, f.ring)));
}

// First two edges that meet, by a sweep along x.
std::optional<std::pair<Edge, Edge>> first_meeting(std::vector<Edge> edges, double touch) {
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.low_x() < b.low_x(); });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low_x() <= edges[i].high_x() + touch; ++j) {
      if (meet(edges[i], edges[j], touch)) return std::pair{edges[i], edges[j]};
    }
  }
  return std::nullopt;
}

class OutlineCheck {
 public:
  OutlineCheck(const std::string& label, const Place& place, Problems& problems)
      : label_(label), place_(place), problems_(problems) {}

  bool corners(Ring3& ring, const std::string& what) {
    if (ring.size() > kMaxCorners)
      return complain(
          fmt::format("{} has {} corners, at most {} are accepted", what, ring.size(), kMaxCorners),
          "split the surface");
    drop_repeats(ring);
    if (ring.size() < 3)
      return complain(fmt::format("{} has {} different corners, at least 3 are needed", what, ring.size()));
    const double length = length_around(ring);
    const double least = kMinRelativeArea * length * length;
    if (glm::length(newell(ring)) / 2.0 > least) return true;
    if (largest_corner_area(ring) > least)
      return complain(fmt::format("{} crosses itself: the areas of its parts cancel", what),
                      "list the corners once round");
    return complain(fmt::format("{} has zero area: its corners lie on one line", what));
  }

  bool plane(const Ring3& outline, const std::vector<Ring3>& holes) {
    const double size = extent(outline);
    const Vec3 normal = glm::normalize(newell(outline));
    const Vec3 origin = centre(outline);
    double worst = 0.0;
    for (const auto& p : outline) worst = std::max(worst, std::abs(glm::dot(p - origin, normal)));
    if (worst > kPlanarityTolerance * size)
      return complain(
          fmt::format("corners lie up to {} m out of one plane, {:.2g} of its size; at most {} is accepted",
                      short_number(worst), worst / size, kPlanarityTolerance),
          "split it into triangles");
    for (std::size_t i = 0; i < holes.size(); ++i) {
      for (const auto& p : holes[i]) {
        const double off = std::abs(glm::dot(p - origin, normal));
        if (off > kPlanarityTolerance * size)
          return complain(
              fmt::format("hole {} lies {} m off the plane of the outline", i + 1, short_number(off)));
      }
    }
    return true;
  }

  bool crossings(const Ring3& outline, const std::vector<Ring3>& holes) {
    Frame frame;
    frame.origin = centre(outline);
    frame.n = glm::normalize(newell(outline));
    frame.u = perpendicular(frame.n);
    frame.v = glm::cross(frame.n, frame.u);
    std::vector<Ring2> rings(1 + holes.size());
    for (const auto& p : outline) rings[0].push_back(frame.to_local(p));
    for (std::size_t i = 0; i < holes.size(); ++i)
      for (const auto& p : holes[i]) rings[i + 1].push_back(frame.to_local(p));
    std::vector<Edge> edges;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const std::size_t n = rings[r].size();
      for (std::size_t i = 0; i < n; ++i) edges.push_back({rings[r][i], rings[r][(i + 1) % n], r, i, n});
    }
    if (const auto pair = first_meeting(edges, kTouch * extent(outline)))
      return complain(meeting_text(pair->first, pair->second),
                      pair->first.ring == pair->second.ring
                          ? "list the corners once round; write openings as holes"
                          : "holes lie wholly inside the outline and apart from each other");
    for (std::size_t r = 1; r < rings.size(); ++r) {
      if (!contains(rings[0], rings[r][0]))
        return complain(fmt::format("hole {} lies outside the outline", r));
      for (std::size_t other = 1; other < rings.size(); ++other) {
        if (other != r && contains(rings[other], rings[r][0]))
          return complain(fmt::format("hole {} lies inside hole {}", r, other));
      }
    }
    return true;
  }

 private:
  static Vec3 centre(const Ring3& ring) {
    Vec3 sum(0.0);
    for (const auto& p : ring) sum += p;
    return sum / static_cast<double>(ring.size());
  }

  bool complain(const std::string& what, const std::string& cure = "") {
    problems_.add(place_, label_ + ": " + what, cure);
    return false;
  }

  const std::string& label_;
  const Place& place_;
  Problems& problems_;
};

}  // namespace

bool check_outline(Ring3& outline, std::vector<Ring3>& holes, const std::string& label, const Place& place,
                   Problems& problems) {
  OutlineCheck check(label, place, problems);
  if (!check.corners(outline, "outline")) return false;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (!check.corners(holes[i], fmt::format("hole {}", i + 1))) return false;
  }
  return check.plane(outline, holes) && check.crossings(outline, holes);
}

}  // namespace dim
