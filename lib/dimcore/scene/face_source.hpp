#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "geometry/polygon.hpp"

namespace dim {

class TomlTable;

/// One face as the zone file writes it, boxes and copies expanded. Lengths are in the file's unit.
struct FaceSource {
  std::string name;
  Ring3 outline;
  std::vector<Ring3> holes;
  std::string finish;
  std::string on;  ///< parent's name for a feature, else empty
  bool two_sided = false;
  bool outside = false;
  bool of_box = false;
  std::optional<double> cell;
  std::optional<std::pair<int, int>> grid;
  std::string group;  ///< of a window
  struct State {
    std::string name, finish;
    Place place;
  };
  std::vector<State> states;
  Place place;  ///< of the name
  Place vertices_place;
  Place finish_place;
  Place on_place;
};

/// Largest number of cells along one side of a surface or plane that a file may ask for.
inline constexpr int kMaxGrid = 10000;

/// Most surfaces of a zone.
inline constexpr std::size_t kMaxSurfaces = 100'000;

/// Reads [[room]], [[surface]], [[box]] and [[copy]], in this order. Duplicate names, boxes of no size and
/// copies of unknown things are reported.
/// @throws InputError  more than kMaxSurfaces
std::vector<FaceSource> read_faces(const TomlTable& root);

/// The six faces of a box, outward: top bottom south north west east in the box's own axes (south = -y),
/// turned about the vertical through its corner.
std::vector<FaceSource> box_faces(const std::string& name, const Vec3& corner, const Vec3& size,
                                  double turn_deg);

}  // namespace dim
