#pragma once

#include "import/import_input.hpp"

namespace dim {

/// COLLADA 1.4 and 1.5: the meshes of its scene, moved by its nodes; unit and axis as the file states; the
/// diffuse colour of an effect is the reflectance. Cameras, lights, skins and pictures are named.
/// @throws InputError  also for nodes that hold themselves
ImportedModel read_dae(const ImportInput& input);

}  // namespace dim
