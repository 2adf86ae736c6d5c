#include "dimdbm/entries.hpp"

#include <filesystem>

#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/program.hpp"
#include "database/surface_entry.hpp"
#include "database/toml_reader.hpp"
#include "photometry/photometry_file.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

Found read_entry(const std::string& kind, const std::string& path, const std::string& name,
                 Warnings& warnings) {
  if (kind == kFittings) return {read_fitting_record(path, name, warnings), path};
  return {read_surface_entry(read_text_file(path, kMaxTomlBytes), path, name), path};
}

// "fittings/x" asks for a kind.
bool names_kind(const std::string& name, const std::string& kind, std::string& rest) {
  if (name.rfind(kind + "/", 0) != 0) return false;
  rest = name.substr(kind.size() + 1);
  return rest.find('/') == std::string::npos && fs::path(rest).extension() != ".toml";
}

}  // namespace

void add_manage_option(CLI::App& app, std::string& folder) {
  app.add_option("--db", folder, "Database folder to change; db in the current folder unless said")
      ->type_name("DIR")
      ->group("Input");
}

DatabaseSearch databases_to_list(const std::string& option) {
  DatabaseSearch search = database_search(option, "-");
  if (!option.empty()) search.folders.resize(1);
  return search;
}

std::string managed_database(const std::string& option) { return option.empty() ? "db" : option; }

bool is_fitting_text(const std::string& text, const std::string& file) {
  for (const char* kind : {"fitting", "surface"}) {
    try {
      const toml::table root = parse_toml(text, file, {kind, 1, false, {}});
      if (root.contains("dim")) return std::string_view(kind) == "fitting";
      return root.contains("file");
    } catch (const InputError&) {
      // Another kind of file, or no TOML at all: the reader of the kind taken will say which.
    }
  }
  return true;
}

std::vector<std::string> own_files(const std::string& folder, const std::string& name) {
  const auto named_by = [&](const std::string& entry) -> std::string {
    try {
      const std::string path = (fs::path(folder) / (entry + ".toml")).string();
      return fs::path(read_fitting_entry(read_text_file(path, kMaxTomlBytes), path, entry).file)
          .lexically_normal()
          .string();
    } catch (const Error&) {
      return {};
    }
  };
  const std::string file = named_by(name);
  if (file.empty() || fs::path(file).parent_path().lexically_normal() != fs::path(folder).lexically_normal())
    return {};
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".toml" && it->path().stem() != name &&
        named_by(it->path().stem().string()) == file)
      return {};
  return {fs::path(file).filename().string()};
}

Found find_entry_or_file(const DatabaseSearch& search, const std::string& name, Warnings& warnings) {
  std::string rest;
  for (const char* kind : {kFittings, kSurfaces}) {
    const bool asked = names_kind(name, kind, rest);
    if (!asked && name.find('/') != std::string::npos) continue;
    if (const auto path = search.find(kind, asked ? rest : name))
      return read_entry(kind, *path, asked ? rest : name, warnings);
  }
  std::error_code error;
  if (is_photometric_name(name) || (name == "-")) return {fitting_record_of_file(name, warnings), name};
  if (fs::path(name).extension() == ".toml") {
    const std::string text = read_text_file(name, kMaxTomlBytes);
    return read_entry(is_fitting_text(text, name) ? kFittings : kSurfaces, name,
                      fs::path(name).stem().string(), warnings);
  }
  if (fs::exists(name, error))
    throw InputError({{name, 0, 0},
                      "is neither an .ies, .ldt nor .toml file, and no entry has this name",
                      "dimdbm add reads spectra (.csv)"});
  auto known = search.names(kFittings);
  for (auto& surface : search.names(kSurfaces)) known.push_back(std::move(surface));
  throw InputError(
      {{},
       "no entry '" + name + "' in " + search.places(kFittings) + ", " + search.places(kSurfaces),
       did_you_mean(name, known)});
}

}  // namespace dim
