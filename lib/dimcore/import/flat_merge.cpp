#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "import/flat_faces.hpp"

namespace dim {
namespace {

struct Edge {
  std::uint32_t from = 0, to = 0;
  auto operator<=>(const Edge&) const = default;
};

/// A directed edge of a face, to be sorted so that those between the same corners lie together.
struct FaceEdge {
  std::uint32_t low = 0, high = 0, face = 0;
  bool upwards = true;  ///< from low to high
  auto operator<=>(const FaceEdge&) const = default;
};

template <class Function>
void for_edges(const MeshFace& face, Function&& f) {
  for (const CornerRing& ring : face.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) f(ring[i], ring[(i + 1) % ring.size()]);
}

class FlatMerge {
 public:
  explicit FlatMerge(const FaceMesh& mesh) : mesh_(mesh) {
    const std::size_t n = mesh.faces.size();
    for (std::size_t f = 0; f < n; ++f) {
      const Vec3 twice = newell(mesh, mesh.faces[f]);
      areas_.push_back(glm::length(twice) / 2.0);
      normals_.push_back(glm::normalize(twice));
      for_edges(mesh.faces[f], [&](std::uint32_t a, std::uint32_t b) {
        edges_.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f), a < b});
      });
    }
    std::sort(edges_.begin(), edges_.end());
    find_neighbours(n);
    taken_.assign(n, false);
    turned_.assign(n, false);
  }

  std::vector<MeshFace> run(ImportReport& report) {
    std::vector<std::size_t> by_area(areas_.size());
    std::iota(by_area.begin(), by_area.end(), std::size_t{0});
    std::stable_sort(by_area.begin(), by_area.end(),
                     [&](std::size_t a, std::size_t b) { return areas_[a] > areas_[b]; });
    for (const std::size_t seed : by_area)
      if (!taken_[seed]) add(grown_from(seed));
    // In the file's order.
    std::sort(merged_.begin(), merged_.end(),
              [](const Merged& a, const Merged& b) { return a.first < b.first; });
    std::vector<MeshFace> faces;
    for (Merged& merged : merged_) {
      if (merged.n > 1) report.n_merged += merged.n;
      faces.push_back(std::move(merged.face));
    }
    return faces;
  }

 private:
  struct Merged {
    std::size_t first = 0, n = 0;  ///< the first of the faces it is made of, and how many
    MeshFace face;
  };

  bool may_join(const MeshFace& a, const MeshFace& b) const {
    return a.object == b.object && a.material == b.material && a.back_material == b.back_material &&
           a.lit == b.lit;
  }

  void find_neighbours(std::size_t n) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t first = 0, last; first < edges_.size(); first = last) {
      last = first + 1;
      while (last < edges_.size() && edges_[last].low == edges_[first].low &&
             edges_[last].high == edges_[first].high)
        ++last;
      // Where more meet, neighbours in the list will do: those beyond are reached over other edges.
      for (std::size_t i = first; i + 1 < last; ++i)
        for (std::size_t k = i + 1; k < std::min(last, i + 8); ++k)
          if (edges_[i].face != edges_[k].face &&
              may_join(mesh_.faces[edges_[i].face], mesh_.faces[edges_[k].face])) {
            pairs.emplace_back(edges_[i].face, edges_[k].face);
            pairs.emplace_back(edges_[k].face, edges_[i].face);
          }
    }
    std::sort(pairs.begin(), pairs.end());
    first_neighbour_.assign(n + 1, 0);
    for (const auto& [a, b] : pairs) ++first_neighbour_[a + 1], neighbours_.push_back(b);
    std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
  }

  /// The faces in one plane with `seed` that hang together with it, turned to agree.
  std::vector<std::size_t> grown_from(std::size_t seed) {
    const Vec3 origin = mesh_.points[mesh_.faces[seed].rings[0][0]], normal = normals_[seed];
    const double limit_m = std::min(mesh_.tolerance_m, kFlat * diagonal_m(mesh_, mesh_.faces[seed].rings[0]));
    const auto lies_in_plane = [&](std::size_t f) {
      bool flat = true;
      for_edges(mesh_.faces[f], [&](std::uint32_t a, std::uint32_t) {
        flat = flat && std::abs(glm::dot(mesh_.points[a] - origin, normal)) <= limit_m;
      });
      return flat;
    };
    std::vector<std::size_t> part = {seed};
    taken_[seed] = true;
    for (std::size_t k = 0; k < part.size(); ++k)
      for (std::size_t i = first_neighbour_[part[k]]; i < first_neighbour_[part[k] + 1]; ++i) {
        const std::size_t next = neighbours_[i];
        const double agree = glm::dot(normals_[next], normal);
        if (taken_[next] || std::abs(agree) < 0.9 || !lies_in_plane(next)) continue;
        const MeshFace& face = mesh_.faces[next];
        if (agree < 0.0 && (face.lit != Lit::unknown || face.back_material >= 0)) continue;
        taken_[next] = true;
        turned_[next] = agree < 0.0;
        part.push_back(next);
      }
    std::sort(part.begin(), part.end());
    return part;
  }

  void add(const std::vector<std::size_t>& part) {
    if (auto rings = rings_of(part)) {
      MeshFace face = mesh_.faces[part[0]];
      face.rings = std::move(*rings);
      merged_.push_back({part[0], part.size(), std::move(face)});
      return;
    }
    if (part.size() == 1) {
      merged_.push_back({part[0], 1, mesh_.faces[part[0]]});
      return;
    }
    for (const auto& half : halves(part)) add(half);
  }

  /// The boundary of the faces: an outline, then holes. Nothing where it touches itself, has more outlines
  /// than one, or edges that lie on each other.
  std::optional<std::vector<CornerRing>> rings_of(const std::vector<std::size_t>& part) const {
    std::vector<Edge> edges;
    for (const std::size_t f : part)
      for_edges(mesh_.faces[f], [&](std::uint32_t a, std::uint32_t b) {
        edges.push_back(turned_[f] ? Edge{b, a} : Edge{a, b});
      });
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return std::nullopt;
    std::vector<Edge> boundary;
    for (const Edge& edge : edges)
      if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.to, edge.from})) boundary.push_back(edge);
    auto rings = chained(boundary);
    if (!rings) return std::nullopt;
    return with_outline_first(*rings, part) ? rings : std::nullopt;
  }

  /// False where there is more than one outline. A single face is one region whatever its rings' directions:
  /// files of other programs also walk round holes the wrong way.
  bool with_outline_first(std::vector<CornerRing>& rings, const std::vector<std::size_t>& part) const {
    const Vec3 normal = turned_[part[0]] ? -normals_[part[0]] : normals_[part[0]];
    std::vector<double> areas;
    for (const CornerRing& ring : rings) areas.push_back(glm::dot(newell(corners_of(mesh_, ring)), normal));
    const auto largest =
        static_cast<std::size_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (i == largest || areas[i] <= 0.0) continue;
      if (part.size() > 1) return false;
      std::reverse(rings[i].begin(), rings[i].end());
    }
    std::swap(rings[0], rings[largest]);
    return areas[largest] > 0.0;
  }

  /// @param edges  sorted
  static std::optional<std::vector<CornerRing>> chained(const std::vector<Edge>& edges) {
    std::vector<bool> used(edges.size(), false);
    std::vector<CornerRing> rings;
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (edges[i].from == edges[i - 1].from) return std::nullopt;
    for (std::size_t start = 0; start < edges.size(); ++start) {
      CornerRing ring;
      for (std::size_t at = start; !used[at];) {
        used[at] = true;
        ring.push_back(edges[at].from);
        const auto next = std::lower_bound(edges.begin(), edges.end(), Edge{edges[at].to, 0});
        if (next == edges.end() || next->from != edges[at].to) return std::nullopt;
        at = static_cast<std::size_t>(next - edges.begin());
      }
      if (ring.size() == 1 || ring.size() == 2) return std::nullopt;
      if (!ring.empty()) rings.push_back(std::move(ring));
    }
    if (rings.empty()) return std::nullopt;
    return rings;
  }

  Vec3 middle(std::size_t f) const {
    Vec3 sum(0.0);
    double n = 0.0;
    for_edges(mesh_.faces[f], [&](std::uint32_t a, std::uint32_t) { sum += mesh_.points[a], ++n; });
    return sum / n;
  }

  /// Both halves along the longest extent, each in parts that hang together.
  std::vector<std::vector<std::size_t>> halves(const std::vector<std::size_t>& part) const {
    Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const std::size_t f : part) low = glm::min(low, middle(f)), high = glm::max(high, middle(f));
    const Vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::vector<std::size_t> sorted = part;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::size_t a, std::size_t b) { return middle(a)[axis] < middle(b)[axis]; });
    const auto half = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::vector<std::vector<std::size_t>> parts;
    for (auto faces :
         {std::vector<std::size_t>(sorted.begin(), half), std::vector<std::size_t>(half, sorted.end())})
      for (auto& connected : connected_parts(std::move(faces))) parts.push_back(std::move(connected));
    return parts;
  }

  std::vector<std::vector<std::size_t>> connected_parts(std::vector<std::size_t> faces) const {
    std::sort(faces.begin(), faces.end());
    std::vector<bool> done(faces.size(), false);
    std::vector<std::vector<std::size_t>> parts;
    for (std::size_t start = 0; start < faces.size(); ++start) {
      if (done[start]) continue;
      done[start] = true;
      std::vector<std::size_t> part = {faces[start]};
      for (std::size_t k = 0; k < part.size(); ++k)
        for (std::size_t i = first_neighbour_[part[k]]; i < first_neighbour_[part[k] + 1]; ++i) {
          const auto found = std::lower_bound(faces.begin(), faces.end(), neighbours_[i]);
          if (found == faces.end() || *found != neighbours_[i]) continue;
          const auto place = static_cast<std::size_t>(found - faces.begin());
          if (done[place]) continue;
          done[place] = true;
          part.push_back(neighbours_[i]);
        }
      std::sort(part.begin(), part.end());
      parts.push_back(std::move(part));
    }
    return parts;
  }

  const FaceMesh& mesh_;
  std::vector<double> areas_;
  std::vector<Vec3> normals_;
  std::vector<FaceEdge> edges_;
  std::vector<std::size_t> first_neighbour_,
      neighbours_;  ///< of face f: neighbours_[first[f] … first[f + 1])
  std::vector<bool> taken_, turned_;
  std::vector<Merged> merged_;
};

}  // namespace

void merge_flat_faces(FaceMesh& mesh, ImportReport& report) { mesh.faces = FlatMerge(mesh).run(report); }

}  // namespace dim
