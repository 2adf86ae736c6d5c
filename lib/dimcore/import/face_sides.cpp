#include "import/face_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dim {
namespace {

/// A face at an edge, which runs from the lower corner number to the higher.
struct Spoke {
  std::uint32_t low = 0, high = 0, face = 0;
  bool upwards = true;  ///< the way the face's outline runs
  auto operator<=>(const Spoke&) const = default;
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(a), rb = root(b);
    parent_[std::max(ra, rb)] = std::min(ra, rb);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

class SideJoiner {
 public:
  explicit SideJoiner(const FaceMesh& mesh) : mesh_(mesh), joined_(2 * mesh.faces.size()) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      normals_.push_back(glm::normalize(newell(mesh, mesh.faces[f])));
      for (const CornerRing& ring : mesh.faces[f].rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
          spokes_.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
    }
    std::sort(spokes_.begin(), spokes_.end());
  }

  SideParts run() {
    for (std::size_t first = 0, last; first < spokes_.size(); first = last) {
      last = first + 1;
      while (last < spokes_.size() && spokes_[last].low == spokes_[first].low &&
             spokes_[last].high == spokes_[first].high)
        ++last;
      join_round(first, last);
    }
    gather();
    std::stable_sort(out_.free_edges.begin(), out_.free_edges.end(),
                     [](const FreeEdge& a, const FreeEdge& b) {
                       return glm::length(a.to - a.from) > glm::length(b.to - b.from);
                     });
    return std::move(out_);
  }

 private:
  void join_round(std::size_t first, std::size_t last) {
    const Vec3 &from = mesh_.points[spokes_[first].low], &to = mesh_.points[spokes_[first].high];
    if (last - first == 1) {
      out_.free_edges.push_back({spokes_[first].face, from, to});
      return;
    }
    const Vec3 axis = glm::normalize(to - from), u = perpendicular(axis), v = glm::cross(axis, u);
    struct Around {
      double angle;
      std::uint32_t face;
      bool front_ahead;  ///< the front looks towards larger angles
    };
    std::vector<Around> round;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3& normal = normals_[spokes_[i].face];
      const Vec3 into = glm::cross(normal, spokes_[i].upwards ? axis : -axis);
      const double angle = std::atan2(glm::dot(into, v), glm::dot(into, u));
      round.push_back({angle, spokes_[i].face, glm::dot(glm::cross(axis, into), normal) > 0.0});
    }
    std::stable_sort(round.begin(), round.end(),
                     [](const Around& a, const Around& b) { return a.angle < b.angle; });
    for (std::size_t i = 0; i < round.size(); ++i) {
      const Around &here = round[i], &next = round[(i + 1) % round.size()];
      joined_.join(2 * here.face + (here.front_ahead ? 0 : 1), 2 * next.face + (next.front_ahead ? 1 : 0));
    }
  }

  void gather() {
    const auto n_sides = static_cast<std::uint32_t>(2 * mesh_.faces.size());
    std::vector<std::uint32_t> number(n_sides, n_sides);
    for (std::uint32_t side = 0; side < n_sides; ++side) {
      std::uint32_t& part = number[joined_.root(side)];
      if (part == n_sides) part = static_cast<std::uint32_t>(out_.parts.size()), out_.parts.emplace_back();
      out_.part_of.push_back(part);
      out_.parts[part].sides.push_back(side);
    }
    for (const FreeEdge& edge : out_.free_edges)
      for (const std::uint32_t side : {2 * edge.face, 2 * edge.face + 1})
        out_.parts[out_.part_of[side]].closed = false;
    for (SidePart& part : out_.parts) measure(part);
  }

  void measure(SidePart& part) const {
    Vec3 moment(0.0), vectors(0.0);
    for (const std::uint32_t side : part.sides) {
      const double area = area_m2(mesh_, mesh_.faces[side / 2]);
      part.area_m2 += area;
      moment += area * mesh_.points[mesh_.faces[side / 2].rings[0][0]];
    }
    const Vec3 middle = moment / part.area_m2;
    for (const std::uint32_t side : part.sides) {
      const MeshFace& face = mesh_.faces[side / 2];
      const Vec3 vector = newell(mesh_, face) / (side % 2 == 0 ? 2.0 : -2.0);
      vectors += vector;
      // A side looks away from its face: into what is enclosed.
      part.volume_m3 -= glm::dot(vector, mesh_.points[face.rings[0][0]] - middle) / 3.0;
    }
    part.openness = glm::length(vectors) / part.area_m2;
  }

  const FaceMesh& mesh_;
  UnionFind joined_;
  std::vector<Vec3> normals_;
  std::vector<Spoke> spokes_;
  SideParts out_;
};

}  // namespace

SideParts join_sides(const FaceMesh& mesh) { return SideJoiner(mesh).run(); }

}  // namespace dim
