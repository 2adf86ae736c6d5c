#pragma once

#include <cstdint>
#include <vector>

#include "import/face_mesh.hpp"

namespace dim {

/// Sides of faces that belong to one air space as far as shared edges tell: the inside of a box, its outside,
/// one side of a sheet.
struct SidePart {
  std::vector<std::uint32_t> sides;  ///< 2 f: the front of face f; 2 f + 1: its back
  double area_m2 = 0.0;
  /// Volume that the sides look into: above 0 where they enclose it, below where they stand round a body; of
  /// parts with open edges about their own middle.
  double volume_m3 = 0.0;
  /// Length of the sum of the sides' area vectors over their area: 0 where closed, 1 of a flat sheet.
  double openness = 0.0;
  bool closed = true;  ///< no edge is free
};

/// An edge that belongs to one face alone.
struct FreeEdge {
  std::uint32_t face = 0;
  Vec3 from{0.0}, to{0.0};
};

struct SideParts {
  std::vector<SidePart> parts;         ///< by their first side
  std::vector<std::uint32_t> part_of;  ///< [2 faces]
  std::vector<FreeEdge> free_edges;    ///< longest first
};

/// Joins the sides of faces over the edges they share: of the faces round an edge, those next to each other
/// enclose a wedge of air that the sides towards it share. Free edges join nothing, so that a shell with a
/// gap keeps an inside and an outside.
/// @param mesh  edges noded: shared whole or not at all
SideParts join_sides(const FaceMesh& mesh);

}  // namespace dim
