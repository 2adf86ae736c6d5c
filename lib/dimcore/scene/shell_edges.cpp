#include "scene/shell_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "geometry/box_tree.hpp"

namespace dim {
namespace {

struct Edge {
  std::size_t polygon = 0;
  Vec3 a{0.0}, b{0.0};
  std::size_t from = 0, to = 0;  ///< numbered corners
};

// Gives corners that agree within the tolerance the same number. Cells are much larger than the tolerance, so
// that nearly every corner needs only its own cell.
class CornerNumbers {
 public:
  explicit CornerNumbers(double touch_m) : touch_m_(touch_m), cell_m_(1024.0 * touch_m) {}

  std::size_t number(const Vec3& p) {
    const auto low = cell(p - touch_m_), high = cell(p + touch_m_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells_.find(key(x, y, z));
          if (found == cells_.end()) continue;
          for (const std::size_t i : found->second)
            if (glm::length(corners_[i] - p) <= touch_m_) return i;
        }
    const auto own = cell(p);
    corners_.push_back(p);
    cells_[key(own[0], own[1], own[2])].push_back(corners_.size() - 1);
    return corners_.size() - 1;
  }

 private:
  std::array<std::int64_t, 3> cell(const Vec3& p) const {
    std::array<std::int64_t, 3> result{};
    for (int i = 0; i < 3; ++i)
      result[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(p[i] / cell_m_));
    return result;
  }
  // The zone is about a thousand cells across: 20 bits an axis never run over, and a clash would only cost
  // time.
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    constexpr std::uint64_t kMask = (1u << 20) - 1;
    return (static_cast<std::uint64_t>(x) & kMask) | (static_cast<std::uint64_t>(y) & kMask) << 20 |
           (static_cast<std::uint64_t>(z) & kMask) << 40;
  }

  double touch_m_, cell_m_;
  std::vector<Vec3> corners_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

std::vector<Edge> edges_of(const std::vector<const Polygon*>& polygons, double touch_m) {
  CornerNumbers numbers(touch_m);
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (const auto& ring : polygons[k]->corners()) {
      std::vector<std::size_t> ids;
      for (const auto& p : ring) ids.push_back(numbers.number(p));
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t j = (i + 1) % ring.size();
        if (ids[i] != ids[j]) edges.push_back({k, ring[i], ring[j], ids[i], ids[j]});
      }
    }
  }
  return edges;
}

// Takes whole matches into `shared` and returns the edges that have none.
std::vector<Edge> match_whole(const std::vector<Edge>& edges, std::vector<SharedEdge>& shared) {
  std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::size_t>> keyed;
  for (std::size_t i = 0; i < edges.size(); ++i)
    keyed.push_back({std::minmax(edges[i].from, edges[i].to), i});
  std::sort(keyed.begin(), keyed.end());
  std::vector<Edge> alone;
  for (std::size_t first = 0; first < keyed.size();) {
    std::size_t last = first;
    while (last < keyed.size() && keyed[last].first == keyed[first].first) ++last;
    if (last - first == 1) alone.push_back(edges[keyed[first].second]);
    if (last - first == 2) {
      const Edge &e = edges[keyed[first].second], &f = edges[keyed[first + 1].second];
      shared.push_back({e.polygon, f.polygon, e.from == f.from});
    }
    first = last;
  }
  return alone;
}

struct Overlap {
  double from = 0.0, to = 0.0;  ///< metres along the edge
  std::size_t polygon = 0;
  bool flipped = false;
};

double distance_to_line(const Vec3& p, const Vec3& a, const Vec3& direction) {
  const Vec3 d = p - a;
  return glm::length(d - glm::dot(d, direction) * direction);
}

// Records on both edges where they run along one line together.
void overlap(const Edge& e, const Edge& f, double touch_m, std::vector<Overlap>& on_e,
             std::vector<Overlap>& on_f) {
  const Edge& longer = glm::length(e.b - e.a) >= glm::length(f.b - f.a) ? e : f;
  const Edge& other = &longer == &e ? f : e;
  const Vec3 along = glm::normalize(longer.b - longer.a);
  if (distance_to_line(other.a, longer.a, along) > touch_m ||
      distance_to_line(other.b, longer.a, along) > touch_m)
    return;
  const bool flipped = glm::dot(e.b - e.a, f.b - f.a) > 0.0;
  const auto add = [&](const Edge& base, const Edge& on, std::vector<Overlap>& list) {
    const Vec3 direction = glm::normalize(base.b - base.a);
    auto [low, high] = std::minmax({glm::dot(on.a - base.a, direction), glm::dot(on.b - base.a, direction)});
    low = std::max(low, 0.0);
    high = std::min(high, glm::length(base.b - base.a));
    if (high - low > touch_m) list.push_back({low, high, on.polygon, flipped});
  };
  add(e, f, on_e);
  add(f, e, on_f);
}

// Those of the largest polygon: boxes along them are tight in a room that is turned as a whole too.
Frame axes_of(const std::vector<const Polygon*>& polygons) {
  const auto largest =
      std::max_element(polygons.begin(), polygons.end(),
                       [](const Polygon* a, const Polygon* b) { return a->area_m2() < b->area_m2(); });
  return largest == polygons.end() ? Frame{} : (*largest)->frame();
}

Box3 box_of(const Edge& edge, const Frame& axes) {
  Box3 box;
  box.add(axes.direction_to_local(edge.a));
  box.add(axes.direction_to_local(edge.b));
  return box;
}

std::vector<std::vector<Overlap>> find_overlaps(const std::vector<Edge>& edges, const Frame& axes,
                                                double touch_m) {
  std::vector<std::vector<Overlap>> overlaps(edges.size());
  std::vector<Box3> boxes;
  for (const auto& edge : edges) boxes.push_back(box_of(edge, axes));
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    tree.for_meeting(boxes[i].widened(touch_m), [&](std::size_t j) {
      if (j > i) overlap(edges[i], edges[j], touch_m, overlaps[i], overlaps[j]);
    });
  }
  return overlaps;
}

// Answers whether a point lies on any polygon but one.
class Faces {
 public:
  Faces(const std::vector<const Polygon*>& polygons, const Frame& axes, double touch_m)
      : polygons_(polygons), axes_(axes), touch_m_(touch_m), tree_(boxes_of(polygons, axes)) {}

  bool hold(const Vec3& p, std::size_t but) const {
    bool found = false;
    Box3 at;
    at.add(axes_.direction_to_local(p));
    tree_.for_meeting(at.widened(touch_m_), [&](std::size_t i) {
      const Polygon& polygon = *polygons_[i];
      found = found || (i != but && std::abs(polygon.frame().height(p)) <= touch_m_ &&
                        polygon.contains(polygon.frame().to_local(p), touch_m_));
    });
    return found;
  }

 private:
  static std::vector<Box3> boxes_of(const std::vector<const Polygon*>& polygons, const Frame& axes) {
    std::vector<Box3> boxes;
    for (const auto* polygon : polygons) {
      Box3& box = boxes.emplace_back();
      for (const auto& ring : polygon->corners())
        for (const auto& p : ring) box.add(axes.direction_to_local(p));
    }
    return boxes;
  }

  const std::vector<const Polygon*>& polygons_;
  const Frame& axes_;
  double touch_m_;
  BoxTree tree_;
};

bool rests_on_face(const Vec3& from, const Vec3& to, std::size_t own, const Faces& faces) {
  constexpr std::array<double, 5> kSamples = {0.02, 0.27, 0.5, 0.71, 0.98};
  return std::all_of(kSamples.begin(), kSamples.end(),
                     [&](double t) { return faces.hold(from + t * (to - from), own); });
}

// Walks along one edge: where one other lies on it they share it, where none does it may leak.
void settle(const Edge& edge, std::vector<Overlap>& overlaps, double touch_m, const Faces& faces,
            ShellEdges& result) {
  const double length = glm::length(edge.b - edge.a);
  const Vec3 along = (edge.b - edge.a) / length;
  std::vector<double> marks = {0.0, length};
  for (const auto& o : overlaps) marks.push_back(o.from), marks.push_back(o.to);
  std::sort(marks.begin(), marks.end());
  std::sort(overlaps.begin(), overlaps.end(),
            [](const Overlap& a, const Overlap& b) { return a.from < b.from; });
  std::vector<const Overlap*> here;
  std::size_t next = 0;
  double open_from = -1.0;
  const auto close = [&](double at) {
    if (open_from < 0.0) return;
    const Vec3 from = edge.a + open_from * along, to = edge.a + at * along;
    if (at - open_from > touch_m && !rests_on_face(from, to, edge.polygon, faces))
      result.leaking.push_back({edge.polygon, from, to});
    open_from = -1.0;
  };
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    if (marks[i + 1] - marks[i] <= touch_m) continue;
    const double middle = (marks[i] + marks[i + 1]) / 2.0;
    while (next < overlaps.size() && overlaps[next].from < middle) here.push_back(&overlaps[next++]);
    std::erase_if(here, [&](const Overlap* o) { return o->to <= middle; });
    if (here.empty()) {
      if (open_from < 0.0) open_from = marks[i];
      continue;
    }
    close(marks[i]);
    const Overlap& only = *here.front();
    if (here.size() == 1 && only.polygon != edge.polygon && edge.polygon < only.polygon)
      result.shared.push_back({edge.polygon, only.polygon, only.flipped});
  }
  close(length);
}

}  // namespace

ShellEdges match_edges(const std::vector<const Polygon*>& polygons, double touch_m) {
  ShellEdges result;
  const std::vector<Edge> alone = match_whole(edges_of(polygons, touch_m), result.shared);
  const Frame axes = axes_of(polygons);
  auto overlaps = find_overlaps(alone, axes, touch_m);
  const Faces faces(polygons, axes, touch_m);
  for (std::size_t i = 0; i < alone.size(); ++i) settle(alone[i], overlaps[i], touch_m, faces, result);
  std::stable_sort(result.leaking.begin(), result.leaking.end(),
                   [](const LeakingEdge& a, const LeakingEdge& b) {
                     return glm::length(a.to - a.from) > glm::length(b.to - b.from) * (1.0 + 1e-9);
                   });
  return result;
}

}  // namespace dim
