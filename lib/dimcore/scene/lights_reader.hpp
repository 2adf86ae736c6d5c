#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "database/search.hpp"
#include "scene/fitting_shelf.hpp"
#include "scene/lights.hpp"
#include "scene/luminaire_field.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Reads a lights file (interface.md) for a zone, fields expanded (read_field). A luminaire's group is the
/// entry's own name where it does not say. Refused by name: a position outside the bounding box of the zone's
/// surfaces. Warned of: a luminaire that lies on a surface and sends light into it, a dim factor above 2.
///
/// @param text       UTF-8 TOML
/// @param file_name  for messages, and the folder that .ies paths are relative to
/// @param overrides  `--set KEY=VALUE`, see `parse_toml`
/// @param load       reads photometric files and database entries; the default reads from disk
/// @throws InputError  every problem together; problems inside a photometric file with places in that file
Lights read_lights(std::string_view text, const std::string& file_name,
                   const std::vector<std::string>& overrides, const Zone& zone, const DatabaseSearch& search,
                   Warnings& warnings, const FileLoader& load = load_from_disk());

}  // namespace dim
