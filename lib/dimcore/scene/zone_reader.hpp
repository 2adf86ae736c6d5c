#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "database/search.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Reads a zone file (interface.md) into the validated model: metres, centre of the bounding box of all
/// surfaces at the origin, boxes and copies expanded, features cut out of their parents, the common area of
/// faces that touch back to back taken away on both sides (it never sees light).
///
/// @param text             the file's text, UTF-8 TOML
/// @param file_name        for messages only
/// @param overrides        `--set KEY=VALUE`, see `parse_toml`
/// @param cell_override_m  takes the place of the file's `cell` (not of a surface's own); 0: none
/// @param warnings         added to: a zone that is not closed, with where it leaks
/// @throws InputError      every problem of the file together, at most 20 shown
Zone read_zone(std::string_view text, const std::string& file_name, const std::vector<std::string>& overrides,
               double cell_override_m, const DatabaseSearch& search, Warnings& warnings);

/// Volume enclosed by the bounding surfaces, m3; meaningful for a closed zone (`Zone::closed`). Obstruction
/// boxes are not taken away. Computed when the zone is read: the divergence theorem over the bounding
/// surfaces before faces that touch are taken away.
inline double zone_volume_m3(const Zone& zone) { return zone.volume_m3; }

}  // namespace dim
