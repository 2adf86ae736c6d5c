#pragma once

#include "import/import_input.hpp"

namespace dim {

/// Adds what a Wavefront material library (MTL) states to the materials of those names.
/// @param library  the file's text; `place` in messages is within it
/// @throws InputError
void read_material_library(std::string_view library, const std::string& name, ImportedModel& model);

}  // namespace dim
