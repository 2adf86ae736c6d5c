#pragma once

#include "import/import_input.hpp"

namespace dim {

/// STL, text or binary: triangles of one solid each. STL has no materials and no unit.
/// @throws InputError
ImportedModel read_stl(const ImportInput& input);

}  // namespace dim
