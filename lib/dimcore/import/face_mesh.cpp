#include "import/face_mesh.hpp"

#include <algorithm>
#include <limits>

namespace dim {

Ring3 corners_of(const FaceMesh& mesh, const CornerRing& ring) {
  Ring3 corners;
  corners.reserve(ring.size());
  for (const std::uint32_t i : ring) corners.push_back(mesh.points[i]);
  return corners;
}

Vec3 newell(const FaceMesh& mesh, const MeshFace& face) {
  Vec3 sum(0.0);
  if (face.rings.empty() || face.rings[0].empty()) return sum;
  const Vec3 origin = mesh.points[face.rings[0][0]];
  for (const CornerRing& ring : face.rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      sum += glm::cross(mesh.points[ring[j]] - origin, mesh.points[ring[i]] - origin);
  return sum;
}

double area_m2(const FaceMesh& mesh, const MeshFace& face) { return glm::length(newell(mesh, face)) / 2.0; }

void turn_round(MeshFace& face) {
  for (CornerRing& ring : face.rings) std::reverse(ring.begin(), ring.end());
  if (face.back_material >= 0) std::swap(face.material, face.back_material);
}

double diagonal_m(const FaceMesh& mesh, const CornerRing& ring) {
  Vec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const std::uint32_t i : ring)
    low = glm::min(low, mesh.points[i]), high = glm::max(high, mesh.points[i]);
  return glm::length(high - low);
}

Polygon polygon_of(const FaceMesh& mesh, const MeshFace& face, const Vec3& origin) {
  std::vector<Ring3> rings;
  for (const CornerRing& ring : face.rings) {
    rings.push_back(corners_of(mesh, ring));
    for (Vec3& p : rings.back()) p -= origin;
  }
  const Ring3 outline = std::move(rings.front());
  rings.erase(rings.begin());
  return Polygon(outline, rings);
}

}  // namespace dim
