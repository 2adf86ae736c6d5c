#include <fmt/format.h>

#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "database/entry_name.hpp"
#include "database/toml_reader.hpp"
#include "dimdbm/commands.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"

namespace dim {

namespace fs = std::filesystem;

RemoveCommand::RemoveCommand(Program& program) : program_(program) {
  remove_ = program.add_command("remove", "Removes entries and the photometric files that only they use",
                                "  dimdbm remove old-lamp");
  remove_->add_option("ENTRY", names_, "Entries to remove")->required()->type_name("")->default_str("");
  remove_
      ->add_option("--kind", kind_, "fittings, surfaces or spectra, where several have an entry of this name")
      ->check(CLI::IsMember({"any", kFittings, kSurfaces, kSpectra}));
  add_manage_option(*remove_, db_);
  program.add_common_options(*remove_);
}

bool RemoveCommand::run() {
  if (!remove_->parsed()) return false;
  const DatabaseSearch search{{managed_database(db_)}};
  std::vector<std::pair<std::string, std::string>> found;
  Problems problems;
  for (const auto& name : names_) {
    std::vector<std::string> kinds;
    for (const char* kind : kKinds)
      if ((kind_ == "any" || kind_ == kind) && search.find(kind, name)) kinds.emplace_back(kind);
    std::vector<std::string> known;
    for (const char* kind : kKinds)
      for (auto& entry : search.names(kind)) known.push_back(std::move(entry));
    if (kinds.empty())
      problems.add({}, fmt::format("no entry '{}' in {}", name, search.folders.front()),
                   did_you_mean(name, known));
    else if (kinds.size() > 1)
      problems.add({}, fmt::format("'{}' is an entry of {}", name, fmt::join(kinds, " and of ")),
                   "say which with --kind");
    else
      found.emplace_back(kinds.front(), name);
  }
  problems.throw_if_any();
  program_.stage(kWritingStage);
  for (const auto& [kind, name] : found) {
    EntryStore store((fs::path(search.folders.front()) / kind).string());
    std::vector<std::string> files = {name + ".toml"};
    if (kind == kFittings)
      for (auto& file : own_files(store.folder(), name)) files.push_back(std::move(file));
    store.remove(files);
    program_.say(fmt::format("removed {}/{}", store.folder(), name));
  }
  return true;
}

ExportCommand::ExportCommand(Program& program) : program_(program) {
  export_ = program.add_command("export",
                                "Writes a fitting, as new, as IES LM-63-2002 or EULUMDAT; any entry as TOML",
                                "  dimdbm export troffer-3600 -o troffer.ldt");
  export_->add_option("ENTRY|FILE", what_, "Entry, or an .ies, .ldt, .xml or entry's .toml file")
      ->required()
      ->type_name("");
  export_->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
  export_->add_option("--format", format_, "ies, ldt or toml; from the output's ending unless said")
      ->check(CLI::IsMember({"ies", "ldt", "toml"}));
  export_->add_flag(
      "--as-used", as_used_,
      "With the entry's lamp and maintenance factors in the intensities, not as keywords beside them");
  add_database_option(*export_, db_);
  program.add_common_options(*export_);
}

namespace {

void add_factor(Photometry& photometry, const char* keyword, double factor) {
  if (factor != 1.0) photometry.keywords.emplace_back(keyword, fmt::format("{:g}", factor));
}

}  // namespace

std::string ExportCommand::text_of(const FittingRecord& record, const std::string& format,
                                   Warnings& warnings) const {
  Photometry photometry = record.photometry;
  const double factor = record.entry.in_use_factor();
  // A word with an underscore is the user's own in LM-63.
  const std::string state = as_used_ ? "_APPLIED_" : "_";
  if (!as_used_) scale(photometry, 1.0 / factor);
  add_factor(photometry, (state + "LAMP_FACTOR").c_str(), record.entry.lamp_factor);
  add_factor(photometry, (state + "MAINTENANCE_FACTOR").c_str(), record.entry.maintenance_factor);
  if (record.entry.spectrum || !record.entry.spectrum_name.empty())
    warnings.push_back({{},
                        "the spectrum is not written: photometric files have no place for it",
                        "keep the entry: --format toml"});
  if (format == "ies") return ies_text(photometry);
  if (factor != 1.0)
    warnings.push_back({{},
                        fmt::format("EULUMDAT has no place for the {} of {:g}: written {}",
                                    record.entry.maintenance_factor == 1.0 ? "lamp factor"
                                    : record.entry.lamp_factor == 1.0      ? "maintenance factor"
                                                                           : "lamp and maintenance factors",
                                    factor, as_used_ ? "with it" : "as new"),
                        ""});
  return eulumdat_text(photometry, warnings);
}

bool ExportCommand::run() {
  if (!export_->parsed()) return false;
  std::string format = format_;
  if (format.empty())
    for (const char* known : {"ies", "ldt", "toml"})
      if (in_capitals(fs::path(output_).extension().string()) == "." + in_capitals(known)) format = known;
  if (format.empty()) throw UsageError("--format is needed where -o does not end in .ies, .ldt or .toml");
  program_.check_output(output_, {what_});
  Warnings warnings;
  const Found found = find_entry_or_file(database_search(db_, "-"), what_, warnings);
  program_.check_output(output_, found.files());
  const FittingRecord* record = found.fitting();
  if (!record && format != "toml")
    throw InputError({{found.path, 0, 0},
                      fmt::format("a {} has no intensities to write as {}",
                                  found.finish() ? "surface" : "spectrum", format),
                      ""});
  if (as_used_ && format == "toml")
    throw UsageError("--as-used has no effect with --format toml: an entry holds its factors");
  std::string text;
  if (format != "toml")
    text = text_of(*record, format, warnings);
  else if (record && (is_photometric_name(found.path) || found.path == "-"))
    text = fitting_entry_text(record->entry);
  else if (found.path.empty())
    text = spectrum_entry_text(*found.spectrum());
  else
    text = read_text_file(found.path, kMaxTomlBytes);
  program_.warn(warnings);
  program_.stage(kWritingStage);
  write_file(output_, text);
  return true;
}

}  // namespace dim
