#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "database/entry_store.hpp"
#include "database/fitting_record.hpp"
#include "database/search.hpp"
#include "reflection/finish.hpp"

namespace dim {

inline constexpr const char* kFittings = "fittings";
inline constexpr const char* kSurfaces = "surfaces";

/// Adds `--db` for commands that change one database.
void add_manage_option(CLI::App& app, std::string& folder);

/// What list and check go through: `--db` alone where it is given, else `db/` in the current folder and the
/// installed database.
DatabaseSearch databases_to_list(const std::string& option);

/// The database to change: `--db`, else `db` in the current folder.
std::string managed_database(const std::string& option);

/// An entry or a file, read.
struct Found {
  std::variant<FittingRecord, Finish> what;
  std::string path;  ///< of the entry's TOML; of the file where there is no entry
  const FittingRecord* fitting() const { return std::get_if<FittingRecord>(&what); }
  const Finish* finish() const { return std::get_if<Finish>(&what); }
};

/// A database entry by its name ("fittings/x" and "surfaces/x" where both kinds have one), or a path of an
/// .ies, .ldt or .toml file.
/// @throws InputError  no such entry (with the nearest name), or something wrong in it; IoError
Found find_entry_or_file(const DatabaseSearch& search, const std::string& name, Warnings& warnings);

/// Whether the text of an entry is a fitting's: its `dim` header, else whether it names a `file`.
bool is_fitting_text(const std::string& text, const std::string& file);

/// The photometric file beside a fitting entry that it names and no other entry of the folder does; none
/// where there is no such file or entry.
std::vector<std::string> own_files(const std::string& folder, const std::string& name);

}  // namespace dim
