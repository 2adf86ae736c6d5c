#pragma once

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"

namespace dim {

/// Makes corners that are nearer than `tolerance_m` one (the first), and takes out corners that then repeat
/// the one before. Faces of fewer than three corners, and of no width beyond the tolerance, are dropped and
/// counted.
/// @param faces        metres, z up
/// @param tolerance_m  above 0
FaceMesh weld(const std::vector<ImportedFace>& faces, double size_m, double tolerance_m,
              ImportReport& report);

/// Gives edges a corner wherever one of another face lies on them, within the tolerance: edges that meet in
/// part are then shared whole.
void node_edges(FaceMesh& mesh);

/// Takes out corners in the middle of straight edges.
void straighten_edges(FaceMesh& mesh);

/// Faces on the same corners become one: copies are dropped and counted; of two that face opposite ways the
/// second's material becomes the back's. Faces whose lit side is known are only dropped as copies.
void join_doubles(FaceMesh& mesh, ImportReport& report);

}  // namespace dim
