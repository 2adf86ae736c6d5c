#include "common/database_option.hpp"

#include <filesystem>

#include "base/version.hpp"
#include "common/program.hpp"

namespace dim {

void add_database_option(CLI::App& app, std::string& folder) {
  app.add_option("--db", folder, "Database folder, looked in first")->type_name("DIR")->group("Input");
}

void refuse_database_file(const std::string& output, const DatabaseSearch& search) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (output == "-" || !fs::is_regular_file(output, error)) return;
  for (const auto& folder : search.folders)
    for (const char* kind : {"fittings", "surfaces", "spectra"})
      if (fs::equivalent(fs::absolute(output).parent_path(), fs::path(folder) / kind, error))
        throw UsageError("'" + output +
                         "' of the database would be replaced by the result\n        give -o another name");
}

DatabaseSearch database_search(const std::string& option, const std::string& input_file) {
  namespace fs = std::filesystem;
  DatabaseSearch search;
  const auto add = [&](const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) search.folders.push_back(folder.string());
  };
  if (!option.empty()) {
    std::error_code error;
    if (!fs::is_directory(option, error)) throw UsageError("--db '" + option + "' is not a folder");
    add(option);
  }
  if (input_file != "-") add(fs::path(input_file).parent_path() / "db");
  add("db");
  add(fs::path(executable_folder()) / "../share/dim/db");
  add(installed_database());
  return search;
}

}  // namespace dim
