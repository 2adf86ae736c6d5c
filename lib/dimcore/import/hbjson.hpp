#pragma once

#include "import/import_input.hpp"

namespace dim {

/// Honeybee model (HBJSON): rooms with their faces, apertures and doors, shades of every kind, modifiers and
/// modifier sets, sensor grids, and luminaires with the IES text that they carry. Air boundaries and
/// apertures between two rooms are left open.
/// @throws InputError
ImportedModel read_hbjson(const ImportInput& input);

}  // namespace dim
