#pragma once

#include <string>
#include <string_view>

#include "database/search.hpp"
#include "reflection/finish.hpp"

namespace dim {

/// Finish from the text of a database entry `surfaces/NAME.toml`:
///   kind = "opaque"    diffuse, specular, roughness, ior, extinction, specular_reflectance, distribution
///   kind = "glazing"   transmittance, reflectance, ior, angular_law, by_angle, direct, bsdf (path from the entry)
/// Quantities marked as curves in Finish are a number or [[nm, value], ...]. `source`, `title`, `licence` are
/// text; `dim = "surface/1"` may begin the file.
/// @param name  becomes Finish::name and Finish::source
/// @throws InputError with every problem of the entry
Finish read_surface_entry(std::string_view text, const std::string& file, const std::string& name);

/// The same from the first folder that has the entry.
/// @throws InputError where no folder has it (with the nearest name), IoError where it cannot be read
Finish find_surface_entry(const DatabaseSearch& search, const std::string& name);

class TomlTable;

/// Reads the finish keys of a table over `finish`, which gives the values of keys not written. Problems are
/// collected in the table's context.
void read_finish_keys(const TomlTable& table, Finish& finish);

/// Reports the one quantity that no finish does without, where it is missing: `diffuse`; of a glazing its
/// `transmittance`, `by_angle` or `bsdf`.
void require_main_key(const TomlTable& table, const Finish& finish);

}  // namespace dim
