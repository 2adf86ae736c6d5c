#include "import/outline_mending.hpp"

#include <algorithm>

#include "geometry/bridge.hpp"
#include "geometry/clip.hpp"
#include "import/ear_clipping.hpp"
#include "scene/outline_check.hpp"

namespace dim {
namespace {

Frame frame_of(const FaceMesh& mesh, const MeshFace& face) {
  Frame frame;
  frame.n = glm::normalize(newell(mesh, face));
  frame.u = perpendicular(frame.n);
  frame.v = glm::cross(frame.n, frame.u);
  Vec3 sum(0.0);
  for (const std::uint32_t i : face.rings[0]) sum += mesh.points[i];
  frame.origin = sum / static_cast<double>(face.rings[0].size());
  return frame;
}

bool is_taken(Ring3 outline, std::vector<Ring3> holes) {
  Problems problems;
  return check_outline(outline, holes, "", {}, problems) && problems.empty();
}

bool is_taken(const FaceMesh& mesh, const MeshFace& face) {
  std::vector<Ring3> rings;
  for (const CornerRing& ring : face.rings) {
    rings.push_back(corners_of(mesh, ring));
    for (Vec3& p : rings.back()) p -= mesh.points[face.rings[0][0]];
  }
  Ring3 outline = std::move(rings.front());
  rings.erase(rings.begin());
  return is_taken(std::move(outline), std::move(rings));
}

class Mending {
 public:
  Mending(FaceMesh& mesh, const MeshFace& face) : mesh_(mesh), face_(face), frame_(frame_of(mesh, face)) {}

  std::vector<MeshFace> run() {
    std::vector<MeshFace> pieces;
    for (const Polygon& polygon : polygons())
      for (MeshFace& piece : pieces_of(polygon)) pieces.push_back(std::move(piece));
    return pieces;
  }

 private:
  Ring2 flat(const CornerRing& ring) const {
    Ring2 flat;
    for (const std::uint32_t i : ring) flat.push_back(frame_.to_local(mesh_.points[i]));
    return flat;
  }

  /// Outer rings with the holes inside them.
  std::vector<Polygon> polygons() const {
    Region2 holes;
    for (std::size_t i = 1; i < face_.rings.size(); ++i) {
      Ring2 hole = flat(face_.rings[i]);
      if (signed_area(hole) < 0.0) std::reverse(hole.begin(), hole.end());
      holes.push_back(std::move(hole));
    }
    const Ring2 outline = flat(face_.rings[0]);
    // Clipped by itself, an outline that crosses itself comes out in parts that do not.
    Region2 region =
        holes.empty() ? clip_intersection({outline}, {outline}) : clip_difference({outline}, holes);
    region = without_slivers(std::move(region), mesh_.tolerance_m);
    std::vector<Polygon> polygons;
    for (const Ring2& ring : region) {
      if (signed_area(ring) <= 0.0) continue;
      std::vector<Ring2> rings = {ring};
      const Polygon alone(frame_, {ring});
      for (const Ring2& hole : region)
        if (signed_area(hole) < 0.0 &&
            alone.contains(alone.frame().to_local(frame_.to_world(middle_of_edge(hole)))))
          rings.push_back(hole);
      polygons.emplace_back(frame_, std::move(rings));
    }
    return polygons;
  }

  static Vec2 middle_of_edge(const Ring2& ring) { return (ring[0] + ring[1]) / 2.0; }

  std::vector<MeshFace> pieces_of(const Polygon& polygon) {
    MeshFace whole = face_;
    whole.rings.clear();
    for (const Ring3& ring : polygon.corners()) whole.rings.push_back(numbered(ring));
    if (is_taken(mesh_, whole)) return {whole};
    std::vector<MeshFace> triangles;
    for (const Ring2& ring : bridged_rings(polygon))
      for (const auto& triangle : ear_triangles(ring)) {
        Ring3 corners;
        for (const std::size_t i : triangle) corners.push_back(polygon.frame().to_world(ring[i]));
        MeshFace piece = face_;
        piece.rings = {numbered(corners)};
        if (area_m2(mesh_, piece) > mesh_.tolerance_m * mesh_.tolerance_m && is_taken(mesh_, piece))
          triangles.push_back(std::move(piece));
      }
    return triangles;
  }

  /// Corners that are the face's own keep their number and place; others are new.
  CornerRing numbered(const Ring3& corners) {
    CornerRing ring;
    for (const Vec3& p : corners) {
      std::uint32_t number = static_cast<std::uint32_t>(mesh_.points.size());
      // Bent faces are flattened for clipping, so that distance counts in their plane only.
      double nearest_m = mesh_.tolerance_m;
      for (const CornerRing& own : face_.rings)
        for (const std::uint32_t i : own) {
          const double distance_m = glm::length(frame_.to_local(mesh_.points[i]) - frame_.to_local(p));
          if (distance_m <= nearest_m) nearest_m = distance_m, number = i;
        }
      if (number == mesh_.points.size()) mesh_.points.push_back(p);
      if (ring.empty() || (ring.back() != number && ring.front() != number)) ring.push_back(number);
    }
    return ring;
  }

  FaceMesh& mesh_;
  const MeshFace& face_;
  Frame frame_;
};

}  // namespace

void mend_outlines(FaceMesh& mesh, ImportReport& report) {
  std::vector<MeshFace> faces;
  for (MeshFace& face : mesh.faces) {
    const bool is_triangle = face.rings.size() == 1 && face.rings[0].size() == 3;
    if (is_triangle || is_taken(mesh, face)) {
      faces.push_back(std::move(face));
      continue;
    }
    ++report.n_mended;
    for (MeshFace& piece : Mending(mesh, face).run()) faces.push_back(std::move(piece));
  }
  mesh.faces = std::move(faces);
}

}  // namespace dim
