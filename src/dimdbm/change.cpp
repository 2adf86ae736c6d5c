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
  remove_->add_option("--kind", kind_, "fittings or surfaces, where both have an entry of this name")
      ->check(CLI::IsMember({"any", kFittings, kSurfaces}));
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
    for (const char* kind : {kFittings, kSurfaces})
      if ((kind_ == "any" || kind_ == kind) && search.find(kind, name)) kinds.emplace_back(kind);
    auto known = search.names(kFittings);
    for (auto& surface : search.names(kSurfaces)) known.push_back(std::move(surface));
    if (kinds.empty())
      problems.add({}, fmt::format("no entry '{}' in {}", name, search.folders.front()),
                   did_you_mean(name, known));
    else if (kinds.size() > 1)
      problems.add({}, fmt::format("'{}' is both a fitting and a surface", name), "say which with --kind");
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
  export_ = program.add_command("export", "Writes a fitting as IES LM-63-2002 or EULUMDAT, any entry as TOML",
                                "  dimdbm export troffer-3600 -o troffer.ldt");
  export_->add_option("ENTRY|FILE", what_, "Entry, or an .ies, .ldt or entry's .toml file")
      ->required()
      ->type_name("");
  export_->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
  export_->add_option("--format", format_, "ies, ldt or toml; from the output's ending unless said")
      ->check(CLI::IsMember({"ies", "ldt", "toml"}));
  add_database_option(*export_, db_);
  program.add_common_options(*export_);
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
  const FittingRecord* record = found.fitting();
  if (!record && format != "toml")
    throw InputError(
        {{found.path, 0, 0}, fmt::format("a surface has no intensities to write as {}", format), ""});
  std::string text;
  if (format == "ies")
    text = ies_text(record->photometry);
  else if (format == "ldt")
    text = eulumdat_text(record->photometry, warnings);
  else if (is_photometric_name(found.path) || found.path == "-")
    text = fitting_entry_text(record->entry);
  else
    text = read_text_file(found.path, kMaxTomlBytes);
  program_.warn(warnings);
  program_.stage(kWritingStage);
  write_file(output_, text);
  return true;
}

}  // namespace dim
