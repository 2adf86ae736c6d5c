#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"
#include "import/imported_model.hpp"

namespace dim {

using CornerRing = std::vector<std::uint32_t>;  ///< indices of points, closed implicitly

/// A flat face by the numbers of its corners.
struct MeshFace {
  /// The outline, counter-clockwise seen from the front, then holes, clockwise.
  std::vector<CornerRing> rings;
  int object = 0;          ///< index into FaceMesh::objects
  int material = 0;        ///< of the front
  int back_material = -1;  ///< of the back, where the file had a face on either side
  Lit lit = Lit::unknown;
};

/// What faces of one name have in common.
struct MeshObject {
  std::string name, room, on;
};

/// Faces over shared corners, metres, z up: what the clean-up steps work on, one after the other.
struct FaceMesh {
  std::vector<Vec3> points;
  std::vector<MeshFace> faces;
  std::vector<MeshObject> objects;
  double size_m = 0.0;       ///< diagonal of the box round all points
  double tolerance_m = 0.0;  ///< corners nearer than this are one
};

Ring3 corners_of(const FaceMesh& mesh, const CornerRing& ring);

/// Twice the vector area: outline less holes.
Vec3 newell(const FaceMesh& mesh, const MeshFace& face);
double area_m2(const FaceMesh& mesh, const MeshFace& face);
/// Diagonal of the box round a ring.
double diagonal_m(const FaceMesh& mesh, const CornerRing& ring);
/// Seen from the other side.
void turn_round(MeshFace& face);

/// The face as a polygon about `origin`.
Polygon polygon_of(const FaceMesh& mesh, const MeshFace& face, const Vec3& origin);

}  // namespace dim
