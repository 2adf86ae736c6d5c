#include "geometry/hidden_lines.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/segment_grid.hpp"

namespace dim {
namespace {

constexpr double kTouch = 1e-7;        // of the diameter
constexpr double kNear = 1e-6;         // of the diameter
constexpr double kShortest_px = 1e-6;  // pieces and lines shorter than that are nothing
constexpr double kAsNear = 1e-9;       // relative difference of depths that counts as none

struct Span {
  double start, end;  // along an edge's image, 0..1
};

// The part of a polygon's edge that is in the picture, were nothing before it.
struct Edge {
  int plate = -1;
  Vec3 a{0.0}, b{0.0};
  Vec2 image_a{0.0}, image_b{0.0};
  // What is linear along the image: 1/depth, in parallel projection the depth turned round.
  double nearness_a = 0.0, nearness_b = 0.0;
  bool parallel = false;

  double length_px() const { return glm::length(image_b - image_a); }
  Vec2 image_at(double s) const { return image_a + s * (image_b - image_a); }
  double nearness_at(double s) const { return nearness_a + s * (nearness_b - nearness_a); }
  Vec3 at(double s) const { return a + (parallel ? s : s * nearness_b / nearness_at(s)) * (b - a); }
  /// Place along the image of the point a + u * (b - a).
  double image_of(double u) const {
    return parallel ? u : u * nearness_a / ((1.0 - u) * nearness_b + u * nearness_a);
  }
};

// What of `spans` lies outside [start, end].
std::vector<Span> without(const std::vector<Span>& spans, double start, double end) {
  std::vector<Span> result;
  for (const auto& span : spans) {
    if (span.start < std::min(span.end, start)) result.push_back({span.start, std::min(span.end, start)});
    if (std::max(span.start, end) < span.end) result.push_back({std::max(span.start, end), span.end});
  }
  return result;
}

// The plates that are there for this eye; all of them opaque from the side it is on.
std::vector<Plate> plates_facing(const std::vector<Plate>& plates, const Perspective& perspective) {
  std::vector<Plate> result;
  for (const auto& plate : plates) {
    if (!plate.open_back || perspective.faces(plate.polygon->frame().origin, plate.polygon->normal()))
      result.push_back({plate.polygon, false});
  }
  return result;
}

class Drawing {
 public:
  Drawing(const std::vector<Plate>& plates, double diameter_m, const Camera& camera)
      : perspective_(camera),
        plates_(plates_facing(plates, perspective_)),
        caster_(plates_, diameter_m),
        touch_m_(kTouch * diameter_m),
        near_m_(kNear * diameter_m),
        grid_(camera.width, camera.height, 4 * plates_.size()) {
    for (std::size_t i = 0; i < plates_.size(); ++i) add_edges(static_cast<int>(i));
    for (std::size_t i = 0; i < edges_.size(); ++i)
      grid_.add(static_cast<std::uint32_t>(i), edges_[i].image_a, edges_[i].image_b);
  }

  std::vector<Segment2> run(const Job& job) const {
    std::vector<std::vector<Segment2>> parts(edges_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges_.size(), 16), [&](const auto& range) {
      if (job.stopped()) return;
      std::vector<std::uint32_t> found;
      for (std::size_t i = range.begin(); i != range.end(); ++i) parts[i] = visible_parts(i, found);
    });
    job.check();
    std::vector<Segment2> segments;
    for (const auto& part : parts) segments.insert(segments.end(), part.begin(), part.end());
    return joined(std::move(segments));
  }

 private:
  void add_edges(int plate) {
    for (const auto& ring : plates_[static_cast<std::size_t>(plate)].polygon->corners()) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3& a = ring[i];
        const Vec3& b = ring[(i + 1) % ring.size()];
        if (const auto shown = perspective_.clip(a, b, near_m_))
          add_edge(plate, a + shown->first * (b - a), a + shown->second * (b - a));
      }
    }
  }

  void add_edge(int plate, const Vec3& a, const Vec3& b) {
    const auto image_a = perspective_.project(a), image_b = perspective_.project(b);
    if (!image_a || !image_b) return;
    const bool parallel = perspective_.parallel();
    const auto nearness = [&](const Vec3& p) {
      const double depth_m = perspective_.depth_m(p);
      return parallel ? -depth_m : 1.0 / depth_m;
    };
    const Edge edge{plate, a, b, *image_a, *image_b, nearness(a), nearness(b), parallel};
    if (edge.length_px() > kShortest_px && glm::length(b - a) > touch_m_) edges_.push_back(edge);
  }

  std::vector<Segment2> visible_parts(std::size_t index, std::vector<std::uint32_t>& found) const {
    const Edge& edge = edges_[index];
    grid_.near(edge.image_a, edge.image_b, found);
    std::vector<Span> spans{{0.0, 1.0}};
    std::vector<double> cuts;
    for (const std::uint32_t other : found) {
      if (other < index) spans = without_shared(spans, edge, edges_[other]);
      if (other != index) add_crossing(edge, edges_[other], cuts);
    }
    if (spans.empty()) return {};
    add_piercings(edge, cuts);
    std::sort(cuts.begin(), cuts.end());
    std::vector<Segment2> result;
    for (const auto& span : spans) add_visible(edge, span, cuts, result);
    return result;
  }

  // Where two polygons share an edge, or part of one, the first draws it.
  std::vector<Span> without_shared(std::vector<Span> spans, const Edge& edge, const Edge& other) const {
    const double length_m = glm::length(edge.b - edge.a), other_m = glm::length(other.b - other.a);
    const Edge& longer = length_m > other_m ? edge : other;
    const Edge& shorter = length_m > other_m ? other : edge;
    const Vec3 along = (longer.b - longer.a) / std::max(length_m, other_m);
    for (const Vec3& end : {shorter.a, shorter.b}) {
      const Vec3 way = end - longer.a;
      if (glm::length(way - glm::dot(way, along) * along) > touch_m_) return spans;
    }
    const Vec3 direction = (edge.b - edge.a) / (length_m * length_m);
    const double u = glm::dot(other.a - edge.a, direction), v = glm::dot(other.b - edge.a, direction);
    const double start = std::clamp(std::min(u, v), 0.0, 1.0), end = std::clamp(std::max(u, v), 0.0, 1.0);
    if ((end - start) * length_m <= touch_m_) return spans;
    return without(spans, edge.image_of(start), edge.image_of(end));
  }

  // Only an edge as near as this one, or nearer, can begin or end a polygon that hides it.
  static void add_crossing(const Edge& edge, const Edge& other, std::vector<double>& cuts) {
    constexpr double kParallel = 1e-12;
    const Vec2 r = edge.image_b - edge.image_a, v = other.image_b - other.image_a;
    const double determinant = cross(r, v);
    if (std::abs(determinant) <= kParallel * glm::length(r) * glm::length(v)) return;
    const Vec2 gap = other.image_a - edge.image_a;
    const double s = cross(gap, v) / determinant, t = cross(gap, r) / determinant;
    const double slack = kShortest_px / glm::length(v);
    if (!(s > 0.0 && s < 1.0) || t < -slack || t > 1.0 + slack) return;
    const double least = edge.nearness_at(s);
    if (other.nearness_at(t) >= least - kAsNear * std::abs(least)) cuts.push_back(s);
  }

  void add_piercings(const Edge& edge, std::vector<double>& cuts) const {
    constexpr int kMost = 1000;
    const Vec3 way = edge.b - edge.a;
    double u = 0.0;
    int skip = edge.plate;
    for (int i = 0; i < kMost; ++i) {
      const Hit hit = caster_.nearest(edge.a + u * way, way, skip);
      if (hit.plate < 0 || !(u + hit.t < 1.0)) return;
      u += hit.t;
      skip = hit.plate;
      cuts.push_back(edge.image_of(u));
    }
  }

  void add_visible(const Edge& edge, const Span& span, const std::vector<double>& cuts,
                   std::vector<Segment2>& result) const {
    const double shortest = kShortest_px / edge.length_px();
    std::optional<double> begun;  // where the visible part in the making starts
    double start = span.start;
    const auto piece = [&](double end) {
      if (end - start <= shortest) return;
      const bool seen = visible(edge.at((start + end) / 2.0));
      if (seen && !begun) begun = start;
      if (!seen && begun) result.push_back({edge.image_at(*begun), edge.image_at(start)});
      if (!seen) begun.reset();
      start = end;
    };
    for (const double cut : cuts) {
      if (cut > span.start && cut < span.end) piece(cut);
    }
    piece(span.end);
    if (begun) result.push_back({edge.image_at(*begun), edge.image_at(span.end)});
  }

  // Plates in whose planes the point lies do not hide it: it is on their edge, or they are seen edge-on.
  bool visible(const Vec3& point) const {
    Vec3 from = perspective_.origin_towards(point);
    int skip = -1;
    for (std::size_t i = 0; i <= plates_.size(); ++i) {
      const Vec3 way = point - from;
      const double distance_m = glm::length(way);
      if (distance_m <= touch_m_) return true;
      const Hit hit = caster_.nearest(from, way, skip);
      if (hit.plate < 0 || hit.t * distance_m >= distance_m - touch_m_) return true;
      const Frame& frame = plates_[static_cast<std::size_t>(hit.plate)].polygon->frame();
      if (std::abs(frame.height(point)) > touch_m_) return false;
      from += hit.t * way;
      skip = hit.plate;
    }
    return true;
  }

  Perspective perspective_;
  std::vector<Plate> plates_;
  RayCaster caster_;
  double touch_m_;
  double near_m_;
  SegmentGrid grid_;
  std::vector<Edge> edges_;
};

}  // namespace

std::vector<Segment2> hidden_lines(const std::vector<Plate>& plates, double diameter_m, const Camera& camera,
                                   const Job& job) {
  return Drawing(plates, diameter_m, camera).run(job);
}

}  // namespace dim
