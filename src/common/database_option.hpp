#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "database/search.hpp"

namespace dim {

/// Adds `--db DIR`.
void add_database_option(CLI::App& app, std::string& folder);

/// Where entries are looked for: `--db`, then `db/` beside the input file, then `db/` in the current folder,
/// then the installed database (beside the executable's own installation first).
DatabaseSearch database_search(const std::string& option, const std::string& input_file);

/// Refuses an output that would replace an entry of a database, or a photometric file beside one.
/// @throws UsageError
void refuse_database_file(const std::string& output, const DatabaseSearch& search);

}  // namespace dim
