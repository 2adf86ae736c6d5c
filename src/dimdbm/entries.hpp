#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "database/entry_store.hpp"
#include "database/fitting_record.hpp"
#include "database/search.hpp"
#include "database/spectrum_entry.hpp"
#include "reflection/finish.hpp"

namespace dim {

inline constexpr const char* kFittings = "fittings";
inline constexpr const char* kSurfaces = "surfaces";
inline constexpr const char* kKinds[] = {kFittings, kSurfaces, kSpectra};

/// Adds `--db` for commands that change one database.
void add_manage_option(CLI::App& app, std::string& folder);

/// What list and check go through: `--db` alone where it is given, else `db/` in the current folder and the
/// installed database.
DatabaseSearch databases_to_list(const std::string& option);

/// The database to change: `--db`, else `db` in the current folder.
std::string managed_database(const std::string& option);

/// An entry or a file, read.
struct Found {
  std::variant<FittingRecord, Finish, SpectrumEntry> what;
  std::string
      path;  ///< of the entry's TOML; of the file where there is no entry; empty: DIM knows it by itself
  /// The files that it was read from.
  std::vector<std::string> files() const;
  const FittingRecord* fitting() const { return std::get_if<FittingRecord>(&what); }
  const Finish* finish() const { return std::get_if<Finish>(&what); }
  const SpectrumEntry* spectrum() const { return std::get_if<SpectrumEntry>(&what); }
};

/// A database entry by its name ("fittings/x" and "surfaces/x" where several kinds have one), a path of an
/// .ies, .ldt, .xml or .toml file, or a spectrum that DIM knows by itself.
/// @throws InputError  no such entry (with the nearest name), or something wrong in it; IoError
Found find_entry_or_file(const DatabaseSearch& search, const std::string& name, Warnings& warnings);

/// Kind of the entry that a text is, kFittings, kSurfaces or kSpectra: by its `dim` header, else by whether
/// it names a `file` or lists a `power`.
std::string kind_of_text(const std::string& text, const std::string& file);

/// A spectrum that DIM knows by itself.
/// @throws InputError  unknown name
SpectrumEntry built_in_spectrum(const std::string& name);

/// The photometric file beside a fitting entry that it names and no other entry of the folder does; none
/// where there is no such file or entry.
std::vector<std::string> own_files(const std::string& folder, const std::string& name);

}  // namespace dim
