#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "database/search.hpp"
#include "reflection/finish.hpp"

namespace dim {

class TomlTable;

/// Reads `[finishes]`: name = database entry, or a number (grey diffuse), or an inline table of the finish
/// keys, which may start from a database entry: `{ entry = "oak", diffuse = 0.4 }`.
std::vector<Finish> read_finishes(const TomlTable& root, const DatabaseSearch& search);

}  // namespace dim
