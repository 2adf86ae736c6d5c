#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/toml_reader.hpp"
#include "scene/face_source.hpp"

namespace dim {

/// A surface, or the six faces of a box or a room, with the name they share.
struct Shape {
  std::string name;
  std::vector<FaceSource> faces;
};

/// Where a copy stands: mirrored, then turned, both about a vertical line, then displaced.
struct CopyPlace {
  std::string name;     ///< of the copy; for a list of originals what stands before each one's own name
  bool suffix = false;  ///< the name goes behind the original's: "desk[1,0]"
  Vec3 by{0.0};
  Place place;
};

/// What a [[copy]] asks for.
struct CopyPlan {
  std::vector<std::string> of;
  bool of_list = false;  ///< written as a list: copies are called NAME.ORIGINAL
  std::vector<CopyPlace> places;
  double turn_deg = 0.0;
  std::optional<int> mirror_axis;  ///< 0: x changes sign, 1: y
  std::optional<Vec2> about;       ///< where the line stands; the middle of the originals unless said
};

/// Reads a [[copy]]: `of` (a name or a list of names); `names` and `by`, or `count` and `pitch` (copies of a
/// grid along x and y whose first place is the original's own; called NAME[i,j]); `turn`, `mirror`, `about`.
/// @returns nothing where something is wrong, which is reported
std::optional<CopyPlan> read_copy_plan(TomlTable& table);

/// The copies of the originals at one place. A feature `on` an original of the same plan lies on that one's
/// copy, any other stays on its parent. Mirrored faces keep facing the way they did towards the light.
std::vector<Shape> copied(const std::vector<const Shape*>& originals, const CopyPlan& plan,
                          const CopyPlace& place);

}  // namespace dim
