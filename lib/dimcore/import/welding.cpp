#include "import/welding.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "geometry/box_tree.hpp"

namespace dim {
namespace {

/// Numbers points; those within the tolerance of an earlier one get its number.
class PointNumbers {
 public:
  PointNumbers(const Vec3& low, double tolerance_m) : low_(low), tolerance_m_(tolerance_m) {}

  std::uint32_t add(const Vec3& p, std::vector<Vec3>& points) {
    const Cell home = cell_of(p);
    // Cells are two tolerances wide: what is near lies in the home cell or its nearer neighbour along each
    // axis.
    for (int corner = 0; corner < 8; ++corner) {
      const auto found = first_.find(neighbour(home, p, corner));
      if (found == first_.end()) continue;
      for (std::uint32_t i = found->second; i != kNone; i = next_[i])
        if (glm::length(points[i] - p) <= tolerance_m_) return i;
    }
    const auto number = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
    const auto [place, is_new] = first_.emplace(home, number);
    next_.push_back(is_new ? kNone : place->second);
    place->second = number;
    return number;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      const auto mix = [](std::uint64_t h, std::int64_t v) {
        h ^= static_cast<std::uint64_t>(v) + 0x9e3779b97f4a7c15ull + (h << 6) + (h >> 2);
        return h * 0xff51afd7ed558ccdull;
      };
      return mix(mix(mix(0, std::get<0>(cell)), std::get<1>(cell)), std::get<2>(cell));
    }
  };

  Vec3 in_cells(const Vec3& p) const { return (p - low_) / (2.0 * tolerance_m_); }
  Cell cell_of(const Vec3& p) const {
    const Vec3 q = glm::floor(in_cells(p));
    return {static_cast<std::int64_t>(q.x), static_cast<std::int64_t>(q.y), static_cast<std::int64_t>(q.z)};
  }
  Cell neighbour(const Cell& home, const Vec3& p, int corner) const {
    const Vec3 q = in_cells(p), within = q - glm::floor(q);
    const auto step = [&](int axis) -> std::int64_t {
      return corner >> axis & 1 ? (within[axis] < 0.5 ? -1 : 1) : 0;
    };
    return {std::get<0>(home) + step(0), std::get<1>(home) + step(1), std::get<2>(home) + step(2)};
  }

  Vec3 low_;
  double tolerance_m_;
  std::unordered_map<Cell, std::uint32_t, Hash> first_;
  std::vector<std::uint32_t> next_;
};

/// Width of a ring across its longest edge's direction.
bool has_width(const FaceMesh& mesh, const MeshFace& face) {
  double longest_m = 0.0;
  for (const CornerRing& ring : face.rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      longest_m = std::max(longest_m, glm::length(mesh.points[ring[i]] - mesh.points[ring[j]]));
  return glm::length(newell(mesh, face)) > longest_m * mesh.tolerance_m;
}

void without_repeats(CornerRing& ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

class ObjectNumbers {
 public:
  int operator()(const ImportedFace& face, std::vector<MeshObject>& objects) {
    const auto [found, is_new] = numbers_.emplace(std::tie(face.name, face.room, face.on), 0);
    if (is_new) {
      found->second = static_cast<int>(objects.size());
      objects.push_back({face.name, face.room, face.on});
    }
    return found->second;
  }

 private:
  std::map<std::tuple<std::string, std::string, std::string>, int> numbers_;
};

}  // namespace

FaceMesh weld(const std::vector<ImportedFace>& faces, double size_m, double tolerance_m,
              ImportReport& report) {
  FaceMesh mesh;
  mesh.size_m = size_m;
  mesh.tolerance_m = tolerance_m;
  Box3 box;
  for (const ImportedFace& face : faces)
    for (const Vec3& p : face.outline) box.add(p);
  PointNumbers numbers(box.low, tolerance_m);
  ObjectNumbers object_of;
  for (const ImportedFace& face : faces) {
    MeshFace welded;
    const auto add_ring = [&](const Ring3& corners) {
      CornerRing ring;
      for (const Vec3& p : corners) ring.push_back(numbers.add(p, mesh.points));
      without_repeats(ring);
      if (ring.size() >= 3) welded.rings.push_back(std::move(ring));
    };
    add_ring(face.outline);
    if (!welded.rings.empty()) {
      const Vec3 out = newell(mesh, welded);
      for (const Ring3& hole : face.holes) {
        const bool same_way = glm::dot(newell(hole), out) > 0.0;
        add_ring(same_way ? Ring3(hole.rbegin(), hole.rend()) : hole);
      }
    }
    if (welded.rings.empty() || !has_width(mesh, welded)) {
      ++report.n_degenerate;
      continue;
    }
    welded.object = object_of(face, mesh.objects);
    welded.material = face.material;
    welded.lit = face.lit;
    mesh.faces.push_back(std::move(welded));
  }
  return mesh;
}

namespace {

/// Corners on the way from a to b, in order.
CornerRing corners_between(const FaceMesh& mesh, const BoxTree& tree, std::uint32_t a, std::uint32_t b) {
  const Vec3 &from = mesh.points[a], &to = mesh.points[b];
  const Vec3 way = to - from;
  const double length2 = glm::dot(way, way);
  Box3 box;
  box.add(from);
  box.add(to);
  std::vector<std::pair<double, std::uint32_t>> found;
  tree.for_meeting(box.widened(mesh.tolerance_m), [&](std::size_t i) {
    const auto corner = static_cast<std::uint32_t>(i);
    if (corner == a || corner == b) return;
    const double t = glm::dot(mesh.points[i] - from, way) / length2;
    if (t > 0.0 && t < 1.0 && glm::length(mesh.points[i] - (from + t * way)) <= mesh.tolerance_m)
      found.emplace_back(t, corner);
  });
  std::sort(found.begin(), found.end());
  CornerRing corners;
  for (const auto& [t, corner] : found) corners.push_back(corner);
  return corners;
}

}  // namespace

void node_edges(FaceMesh& mesh) {
  std::vector<Box3> boxes(mesh.points.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].add(mesh.points[i]);
  const BoxTree tree(std::move(boxes));
  for (MeshFace& face : mesh.faces)
    for (CornerRing& ring : face.rings) {
      CornerRing noded;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        noded.push_back(ring[i]);
        const CornerRing between = corners_between(mesh, tree, ring[i], ring[(i + 1) % ring.size()]);
        noded.insert(noded.end(), between.begin(), between.end());
      }
      ring = std::move(noded);
    }
}

namespace {

/// Whether corners first + 1 … last - 1 (indices going round) lie on the straight line from first to last.
bool are_on_line(const FaceMesh& mesh, const CornerRing& ring, std::size_t first, std::size_t last,
                 double tolerance_m) {
  const Vec3& from = mesh.points[ring[first % ring.size()]];
  const Vec3 way = mesh.points[ring[last % ring.size()]] - from;
  const double length_m = glm::length(way);
  if (!(length_m > 0.0)) return false;
  double before = 0.0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec3 d = mesh.points[ring[i % ring.size()]] - from;
    const double along = glm::dot(d, way) / length_m;
    if (along <= before || along >= length_m || glm::length(d - along / length_m * way) > tolerance_m)
      return false;
    before = along;
  }
  return true;
}

void straighten(const FaceMesh& mesh, CornerRing& ring) {
  const double tolerance_m = mesh.tolerance_m / 4.0;
  std::size_t start = 0;
  while (start < ring.size() &&
         are_on_line(mesh, ring, start + ring.size() - 1, start + ring.size() + 1, tolerance_m))
    ++start;
  if (start == ring.size()) return;
  CornerRing kept = {ring[start]};
  std::size_t first = start;
  for (std::size_t i = start + 1; i < start + ring.size(); ++i)
    if (!are_on_line(mesh, ring, first, i + 1, tolerance_m)) {
      kept.push_back(ring[i % ring.size()]);
      first = i;
    }
  if (kept.size() >= 3) ring = std::move(kept);
}

}  // namespace

void straighten_edges(FaceMesh& mesh) {
  for (MeshFace& face : mesh.faces)
    for (CornerRing& ring : face.rings) straighten(mesh, ring);
}

namespace {

std::uint64_t hash_of(const std::vector<std::uint32_t>& sorted) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const std::uint32_t i : sorted) h = (h ^ i) * 0x100000001b3ull, h ^= h >> 29;
  return h;
}

std::vector<std::uint32_t> sorted_corners(const MeshFace& face) {
  std::vector<std::uint32_t> all;
  for (const CornerRing& ring : face.rings) all.insert(all.end(), ring.begin(), ring.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

void join_doubles(FaceMesh& mesh, ImportReport& report) {
  std::unordered_multimap<std::uint64_t, std::size_t> kept_by_hash;
  std::vector<MeshFace> kept;
  for (MeshFace& face : mesh.faces) {
    const auto corners = sorted_corners(face);
    const std::uint64_t hash = hash_of(corners);
    bool is_double = false;
    for (auto [i, end] = kept_by_hash.equal_range(hash); i != end && !is_double; ++i) {
      MeshFace& other = kept[i->second];
      if (sorted_corners(other) != corners) continue;
      const bool same_way = glm::dot(newell(mesh, face), newell(mesh, other)) > 0.0;
      if (same_way) {
        is_double = true;
        ++report.n_copies;
      } else if (face.lit == Lit::unknown && other.lit == Lit::unknown) {
        is_double = true;
        ++(other.back_material < 0 ? report.n_pairs : report.n_copies);
        if (other.back_material < 0) other.back_material = face.material;
      }
    }
    if (is_double) continue;
    kept_by_hash.emplace(hash, kept.size());
    kept.push_back(std::move(face));
  }
  mesh.faces = std::move(kept);
}

}  // namespace dim
