#pragma once

#include "import/import_input.hpp"

namespace dim {

/// PLY 1.0, text or binary of either byte order: polygons of any number of corners; their colour (of the
/// face, else the mean of its corners'; sRGB) is its reflectance, one material a colour. Other elements are
/// named.
/// @throws InputError
ImportedModel read_ply(const ImportInput& input);

}  // namespace dim
