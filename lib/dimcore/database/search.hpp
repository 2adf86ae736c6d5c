#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dim {

/// Where database entries are looked for: `surfaces/NAME.toml` and `fittings/NAME.toml` in each folder in
/// turn.
struct DatabaseSearch {
  std::vector<std::string> folders;

  /// Path of the first file `kind/NAME.toml`; nothing when no folder has it or NAME is not a plain name
  /// (letters, digits, '-', '_', '.', '+', ' ' and anything beyond ASCII; no path separators).
  std::optional<std::string> find(const std::string& kind, const std::string& name) const;
  std::optional<std::string> find_surface(const std::string& name) const { return find("surfaces", name); }
  std::optional<std::string> find_fitting(const std::string& name) const { return find("fittings", name); }

  /// Names of all entries of a kind ("surfaces", "fittings"), sorted, each once.
  std::vector<std::string> names(const std::string& kind) const;

  /// "db/surfaces, /usr/share/dim/db/surfaces" for messages; "no database folder" where there is none.
  std::string places(const std::string& kind) const;
};

}  // namespace dim
