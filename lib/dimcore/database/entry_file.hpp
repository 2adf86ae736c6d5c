#pragma once

#include <string>

namespace dim {

/// The text of a database entry.
/// @throws IoError where it cannot be read or is larger than a TOML text may be
std::string read_entry_text(const std::string& path);

}  // namespace dim
