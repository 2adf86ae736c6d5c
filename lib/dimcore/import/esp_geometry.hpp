#pragma once

#include "import/import_input.hpp"

namespace dim {

/// Zone geometry of ESP-r, version 1.1 (tags) and the older type GEN: surfaces, seen from inside the zone,
/// with their construction as finish, transparent ones as glazing; obstruction blocks (`*obs`, `*obs3`,
/// `*obsp`) as external obstructions. Reflectances and transmittances stand in ESP-r's databases and are
/// assumed.
/// @throws InputError
ImportedModel read_esp_geometry(const ImportInput& input);

}  // namespace dim
