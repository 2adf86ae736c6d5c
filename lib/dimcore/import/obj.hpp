#pragma once

#include "import/import_input.hpp"

namespace dim {

/// Wavefront OBJ with the material libraries beside it: polygons of any number of corners, groups and objects
/// (the latest of both names a face), `Kd` as reflectance (luminous mean of the three numbers), `d` and `Tr`
/// below 1 as glazing. Texture coordinates, normals and smoothing carry nothing that DIM uses; other
/// statements are named.
/// @throws InputError  what is no OBJ, with its line
ImportedModel read_obj(const ImportInput& input);

}  // namespace dim
