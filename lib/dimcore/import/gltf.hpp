#pragma once

#include "import/import_input.hpp"

namespace dim {

/// glTF 2.0, .gltf with its buffers inside or beside it, and .glb: triangles, strips and fans of every mesh
/// of the scene, metres and y up by definition. `baseColorFactor` (linear) is the reflectance, a stated
/// metallic factor from 0.5 the metal's; transparent and transmitting materials are glazing. Pictures,
/// lights, cameras, skins and animations are named.
/// @throws InputError  also for compressed geometry, nodes that are their own descendants, and other versions
ImportedModel read_gltf(const ImportInput& input);

}  // namespace dim
