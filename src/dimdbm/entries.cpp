#include "dimdbm/entries.hpp"

#include <filesystem>

#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/program.hpp"
#include "database/surface_entry.hpp"
#include "database/toml_reader.hpp"
#include "photometry/photometry_file.hpp"
#include "spectrum/named_spectra.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

Found read_entry(const DatabaseSearch& search, const std::string& kind, const std::string& path,
                 const std::string& name, Warnings& warnings) {
  if (kind == kFittings) return {read_fitting_record(path, name, warnings, spectrum_finder(search)), path};
  const std::string text = read_text_file(path, kMaxTomlBytes);
  if (kind == kSpectra) return {read_spectrum_entry(text, path, name), path};
  return {read_surface_entry(text, path, name), path};
}

[[noreturn]] void refuse_name(const DatabaseSearch& search, const std::string& name) {
  std::vector<std::string> known = spectrum_names();
  std::string places;
  for (const char* kind : kKinds) {
    for (auto& entry : search.names(kind)) known.push_back(std::move(entry));
    places += (places.empty() ? "" : ", ") + search.places(kind);
  }
  throw InputError({{},
                    search.folders.empty() ? "no entry '" + name + "': there is no database folder"
                                           : "no entry '" + name + "' in " + places,
                    did_you_mean(name, known)});
}

// "fittings/x" asks for a kind.
bool names_kind(const std::string& name, const std::string& kind, std::string& rest) {
  if (name.rfind(kind + "/", 0) != 0) return false;
  rest = name.substr(kind.size() + 1);
  return rest.find('/') == std::string::npos && fs::path(rest).extension() != ".toml";
}

}  // namespace

std::vector<std::string> Found::files() const {
  std::vector<std::string> files = {path};
  if (fitting()) files.push_back(fitting()->entry.file);
  return files;
}

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

std::string kind_of_text(const std::string& text, const std::string& file) {
  constexpr std::pair<const char*, const char*> kHeaders[] = {
      {"fitting", kFittings}, {"surface", kSurfaces}, {"spectrum", kSpectra}};
  for (const auto& [header, kind] : kHeaders) {
    try {
      const toml::table root = parse_toml(text, file, {header, 1, false, {}});
      if (root.contains("dim")) return kind;
      return root.contains("file") ? kFittings : root.contains("power") ? kSpectra : kSurfaces;
    } catch (const InputError&) {
      // Another kind of file, or no TOML at all: the reader of the kind taken will say which.
    }
  }
  return kFittings;
}

SpectrumEntry built_in_spectrum(const std::string& name) {
  SpectrumEntry entry;
  entry.name = name;
  entry.power = find_spectrum(name);
  entry.source = "known to DIM: docs/zone-and-lights.md, spectra by name";
  return entry;
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
  for (const char* kind : kKinds) {
    const bool asked = names_kind(name, kind, rest);
    if (!asked && name.find('/') != std::string::npos) continue;
    if (const auto path = search.find(kind, asked ? rest : name))
      return read_entry(search, kind, *path, asked ? rest : name, warnings);
  }
  std::error_code error;
  if (is_photometric_name(name) || (name == "-")) return {fitting_record_of_file(name, warnings), name};
  if (fs::path(name).extension() == ".toml") {
    const std::string text = read_text_file(name, kMaxTomlBytes);
    return read_entry(search, kind_of_text(text, name), name, fs::path(name).stem().string(), warnings);
  }
  if (const auto foreign = foreign_format(name); !foreign.what.empty())
    throw InputError({{name, 0, 0}, "is " + foreign.what, foreign.cure});
  if (fs::exists(name, error) && !fs::is_directory(name, error))
    throw InputError({{name, 0, 0},
                      "is neither an .ies, .ldt, .xml nor .toml file, and no entry has this name",
                      "dimdbm add reads spectra (.csv, .spdx)"});
  try {
    return {built_in_spectrum(names_kind(name, kSpectra, rest) ? rest : name), ""};
  } catch (const InputError&) {
    refuse_name(search, name);
  }
}

}  // namespace dim
