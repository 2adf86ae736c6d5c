#pragma once

#include "import/import_input.hpp"

namespace dim {

/// gbXML: the surfaces of every space, each seen from inside it (one between two spaces once for either),
/// openings cut out of them, shading surfaces outside. Windows have the visible transmittance of their type;
/// reflectances, which gbXML seldom states, are assumed by what a surface is: floor 0.2, wall 0.5, ceiling
/// 0.7. Air surfaces and openings between two spaces are left open.
/// @throws InputError
ImportedModel read_gbxml(const ImportInput& input);

}  // namespace dim
