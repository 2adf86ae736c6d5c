#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace dim {

/// A space that the faces enclose, or a room that the file names.
struct RoomFigures {
  std::string name;
  std::size_t n_faces = 0;
  double area_before_m2 = 0.0;  ///< of the file's faces; of spaces found: the same as after
  double area_after_m2 = 0.0;
  double volume_before_m3 = 0.0;
  double volume_after_m3 = 0.0;
  bool closed = true;
};

/// What clean-up found and changed, for the summary.
struct ImportReport {
  std::size_t n_read = 0;  ///< faces in the file
  double area_read_m2 = 0.0;
  std::size_t n_written = 0;        ///< surfaces
  double area_written_m2 = 0.0;     ///< of one side of each
  std::size_t n_degenerate = 0;     ///< fewer than three corners, or no width
  std::size_t n_copies = 0;         ///< a second time in the same place
  std::size_t n_pairs = 0;          ///< back to back with another: one face with two sides
  std::size_t n_split = 0;          ///< not flat: cut into triangles
  std::size_t n_mended = 0;         ///< outlines that crossed or touched themselves or their holes
  std::size_t n_merged = 0;         ///< went into larger polygons
  std::size_t n_turned = 0;         ///< faced away from the space they bound
  std::size_t n_outside = 0;        ///< written as external obstructions
  std::vector<std::string> hidden;  ///< names of faces inside bodies, left out
  std::vector<RoomFigures> rooms;
  std::vector<std::string> changes;  ///< further lines: "names replaced: …"
};

}  // namespace dim
