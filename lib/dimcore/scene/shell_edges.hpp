#pragma once

#include <cstddef>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// Two polygons of a shell that share (part of) an edge. In a consistently oriented shell shared edges run in
/// opposite directions; `flipped` where they run the same way, so that one of the two faces the wrong way.
struct SharedEdge {
  std::size_t a = 0;
  std::size_t b = 0;
  bool flipped = false;
};

/// A stretch of edge that nothing else meets.
struct LeakingEdge {
  std::size_t polygon = 0;
  Vec3 from{0.0};
  Vec3 to{0.0};
};

struct ShellEdges {
  std::vector<SharedEdge> shared;    ///< where exactly two polygons meet, in order
  std::vector<LeakingEdge> leaking;  ///< longest first
};

/// Matches the edges of polygons that should enclose a space. Edges meet whole, or in part along one line (a
/// wall of two pieces against one ceiling), or rest on the face of another polygon (a cupboard without a
/// bottom on the floor). Whole matches are found by numbering corners in a hash grid, the rest by a tree
/// of the boxes of what is left.
/// @param touch_m  distance within which corners and lines are the same
ShellEdges match_edges(const std::vector<const Polygon*>& polygons, double touch_m);

}  // namespace dim
