#pragma once

#include <optional>

#include "scene/shape_copy.hpp"

namespace dim {

/// Reads a [[room]]: `size = [length, width]` along x and y, `height`, `floor`, `walls`, `ceiling`
/// (finishes), all required; `name`, `corner` (of the floor, [0, 0, 0]), `turn` (degrees about the vertical
/// through the corner), `cell`, and `wall-s` ... `wall-e` (a finish of that wall's own). It becomes the
/// bounding surfaces floor, ceiling, wall-s, wall-n, wall-w and wall-e, south being -y before turning, each
/// behind "NAME." where the room has a name; features may lie on them.
/// @returns nothing where something is wrong, which is reported
std::optional<Shape> read_room(const TomlTable& table);

}  // namespace dim
