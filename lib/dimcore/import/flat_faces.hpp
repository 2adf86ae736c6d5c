#pragma once

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"

namespace dim {

/// Largest distance of a corner from a face's plane, as a fraction of the face's size, with which it counts
/// as flat: half of what a zone file may have.
inline constexpr double kFlat = 0.5e-4;

/// Cuts faces that are not flat into triangles.
/// @throws LimitError  one of them has more than 10,000 corners
void split_bent_faces(FaceMesh& mesh, ImportReport& report);

/// Joins faces of one object, material and plane that share edges to polygons with holes, and turns edges
/// that run to and fro into holes. Faces whose lit side is unknown are turned to agree with the largest of
/// those they are joined to. Where the result would touch itself in a corner it stays in parts.
void merge_flat_faces(FaceMesh& mesh, ImportReport& report);

}  // namespace dim
