#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "import/face_mesh.hpp"
#include "import/import_report.hpp"

namespace dim {

/// Which side of each face is lit.
enum class FaceUse : std::uint8_t {
  front,          ///< as its corners run, now that it is turned
  both,           ///< a sheet with one space on both sides
  two_spaces,     ///< with a space on either side: two surfaces back to back
  outside,        ///< seen from outside only
  outside_sheet,  ///< a sheet outside
  open,           ///< nothing is there
  hidden          ///< seen from no space
};

inline bool is_outside(FaceUse facing) { return facing == FaceUse::outside || facing == FaceUse::outside_sheet; }

/// The facing of a face whose lit side is stated.
FaceUse stated_facing(Lit lit);

/// Whether a surface is written for the face.
inline bool is_written(FaceUse facing) { return facing != FaceUse::open && facing != FaceUse::hidden; }

/// Decides by what encloses what, and turns faces so that their front is the lit side.
///
/// Sides of faces that share edges form parts (`join_sides`); a part that encloses a volume is a room, unless
/// the faces are those of a body that stands in a room; parts that stand in a room (furniture, sheets) are
/// found by rays, by the majority of what their sides see. Faces with a stated lit side stay as they are.
/// @param inside  a point of the one room that is wanted; nothing: all rooms
/// @returns [faces]
/// @throws InputError  `inside` lies in no room
std::vector<FaceUse> face_rooms(FaceMesh& mesh, const std::optional<Vec3>& inside, ImportReport& report,
                               Warnings& warnings);

}  // namespace dim
