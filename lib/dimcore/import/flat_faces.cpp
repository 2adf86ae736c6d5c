#include "import/flat_faces.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "import/ear_clipping.hpp"
#include "scene/outline_check.hpp"

namespace dim {
namespace {

Frame frame_on(const Vec3& origin, const Vec3& normal) {
  Frame frame;
  frame.origin = origin;
  frame.n = normal;
  frame.u = perpendicular(normal);
  frame.v = glm::cross(frame.n, frame.u);
  return frame;
}

bool is_flat(const FaceMesh& mesh, const MeshFace& face) {
  if (face.rings.size() == 1 && face.rings[0].size() == 3) return true;
  const Vec3 normal = glm::normalize(newell(mesh, face));
  Vec3 centre(0.0);
  double n = 0.0;
  for (const CornerRing& ring : face.rings)
    for (const std::uint32_t i : ring) centre += mesh.points[i], ++n;
  centre /= n;
  const double limit_m = kFlat * diagonal_m(mesh, face.rings[0]);
  for (const CornerRing& ring : face.rings)
    for (const std::uint32_t i : ring)
      if (std::abs(glm::dot(mesh.points[i] - centre, normal)) > limit_m) return false;
  return true;
}

/// With holes a face is cut along its outline alone: what has holes and is bent is rare enough to be told of
/// by the checks of the zone.
void add_triangles(const FaceMesh& mesh, const MeshFace& face, std::vector<MeshFace>& out) {
  const CornerRing& outline = face.rings[0];
  if (outline.size() > kMaxCorners)
    throw LimitError("a face of more than 10,000 corners is not flat\n        cut it into triangles");
  const Frame frame = frame_on(mesh.points[outline[0]], glm::normalize(newell(mesh, face)));
  Ring2 flat;
  for (const std::uint32_t i : outline) flat.push_back(frame.to_local(mesh.points[i]));
  for (const auto& triangle : ear_triangles(flat)) {
    MeshFace part = face;
    part.rings = {{outline[triangle[0]], outline[triangle[1]], outline[triangle[2]]}};
    const bool has_area = area_m2(mesh, part) > diagonal_m(mesh, part.rings[0]) * mesh.tolerance_m / 2.0;
    if (has_area) out.push_back(std::move(part));
  }
}

}  // namespace

void split_bent_faces(FaceMesh& mesh, ImportReport& report) {
  std::vector<MeshFace> faces;
  for (MeshFace& face : mesh.faces) {
    if (face.rings.size() > 1 || is_flat(mesh, face)) {
      faces.push_back(std::move(face));
      continue;
    }
    ++report.n_split;
    add_triangles(mesh, face, faces);
  }
  mesh.faces = std::move(faces);
}

}  // namespace dim
