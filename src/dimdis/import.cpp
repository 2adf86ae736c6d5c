#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/option_checks.hpp"
#include "dimdis/options.hpp"
#include "import/placing.hpp"
#include "photometry/text_scanner.hpp"
#include "scene/length_unit.hpp"
#include "scene/zone_reader.hpp"

namespace dim {
namespace {

/// Files beside the model or in folders below that; other places are none of its business.
std::optional<std::string> read_beside(const std::string& model, std::string name, const Job& job) {
  for (char& c : name)
    if (c == '\\') c = '/';
  const std::filesystem::path relative = std::filesystem::path(name).lexically_normal();
  if (model == "-" || name.empty() || relative.is_absolute() || *relative.begin() == "..")
    return std::nullopt;
  const auto path = std::filesystem::path(model).parent_path() / relative;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  return read_text_file(path.string(), kMaxImportBytes, job);
}

Vec3 point_in(const std::string& text) {
  std::string words = text;
  for (char& c : words)
    if (c == ',') c = ' ';
  TextScanner scanner(words, "");
  Vec3 point(0.0);
  bool ok = true;
  for (int i = 0; i < 3; ++i) ok = ok && parse_number(scanner.take_word(), point[i]);
  if (!ok || !scanner.take_word().empty())
    throw UsageError(fmt::format(
        "--inside '{}' does not read like 2.5,1.8,1.2\n        write x,y,z in metres, z up", text));
  return point;
}

bool says_where_light_leaves(const Problem& warning) {
  return warning.what.starts_with("the zone is not closed");
}

/// One warning a kind, but for the few longest gaps: models of other programs have the same fault in hundreds
/// of places.
Warnings one_of_each(const Warnings& warnings) {
  Warnings kinds;
  std::vector<std::size_t> n;
  for (const Problem& warning : warnings) {
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const Problem& kind) {
      return !kind.cure.empty() && kind.cure == warning.cure && !says_where_light_leaves(kind);
    });
    ++(same == kinds.end() ? n.emplace_back(0) : n[static_cast<std::size_t>(same - kinds.begin())]);
    if (same == kinds.end()) kinds.push_back(warning);
  }
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (n[i] > 1) kinds[i].what += fmt::format(" (and {} more like it)", n[i] - 1);
  return kinds;
}

}  // namespace

ImportCommand::ImportCommand(Program& program) : program_(program) {
  command_ =
      program.add_command("import", "Make a zone file of another program's model",
                          "  dimdis import office.obj --unit mm -o office.zone.toml\n"
                          "  dimdis import house.hbjson -o house.zone.toml --lights-out house.lights.toml");
  command_->add_option("FILE", input_, "Model to read, - for standard input")->type_name("")->required();
  command_->add_option("--format", format_, "Format, in place of what the file's name ends in")
      ->check(CLI::IsMember(import_formats()));
  command_
      ->add_option("--unit", unit_, "Length of one unit, in place of what the file states: mm, cm, m, in, ft")
      ->check(CLI::IsMember({"mm", "cm", "m", "in", "ft"}))
      ->type_name("UNIT");
  command_->add_option("--up", up_, "Axis that points up, in place of what the file states: y, z")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("AXIS");
  command_->add_option("--inside", inside_, "A point of the one room that is wanted, m, z up")
      ->type_name("X,Y,Z");
  command_
      ->add_option("--gap", gap_m_,
                   "Close gaps up to this size, m; default 1e-5 of the model, at most 0.0001")
      ->check(number_within(0.0, HUGE_VAL, true))
      ->default_str("")
      ->type_name("SIZE");
  command_->add_option("--lights-out", lights_, "Also write the file's luminaires")->type_name("FILE");
  command_->add_flag("--strict", strict_, "Every warning is an error");
  command_->add_option("-o,--output", output_, "Zone file to write, - for standard output")
      ->type_name("FILE");
  program.add_common_options(*command_);
}

ImportOptions ImportCommand::options() const {
  ImportOptions options;
  options.unit_m = unit_named(unit_);
  if (!up_.empty()) options.up = up_ == "y" ? UpAxis::y : UpAxis::z;
  if (!inside_.empty()) options.inside = point_in(inside_);
  if (gap_m_ > 0.0) options.gap_m = gap_m_;
  options.zone_name = input_ == "-" ? "imported" : to_utf8(std::filesystem::path(input_).stem().string());
  return options;
}

bool ImportCommand::run(Exit& status) {
  if (!command_->parsed()) return false;
  const std::string format = format_.empty() ? import_format_of(input_) : format_;
  if (format.empty())
    throw UsageError(fmt::format("'{}' does not end in a format's name\n        give --format: {}", input_,
                                 fmt::join(import_formats(), ", ")));
  program_.check_output(output_, {input_});
  if (!lights_.empty()) {
    program_.check_output(lights_, {input_, output_});
    refuse_both_on_stdout(output_, lights_);
  }
  const ImportOptions wanted = options();
  program_.stage("read");
  const Job job = program_.job();
  const std::string bytes = read_text_file(input_, kMaxImportBytes, job);
  const ImportInput input{bytes, input_ == "-" ? "<stdin>" : input_,
                          [&](const std::string& name) { return read_beside(input_, name, job); }, job};
  const ImportResult result = import_file(input, format, wanted);
  tell(result);
  if (strict_ && !result.warnings.empty()) throw InputError(result.warnings, result.warnings.size());
  program_.stage("check");
  status = is_sound(result.zone) ? Exit::done : Exit::check_failed;
  program_.stage(kWritingStage);
  write_file(output_, result.zone);
  write_lights(result);
  program_.stage("");
  return true;
}

void ImportCommand::tell(const ImportResult& result) const {
  program_.say(fmt::format("{}: {}", input_, result.conventions));
  for (const std::string& line : summary_lines(result.report)) program_.say(line);
  constexpr std::size_t kMany = 100'000;
  if (result.report.n_read > kMany)
    program_.say(fmt::format("{} of memory taken", size_in_words(peak_memory_bytes())));
  if (!strict_) program_.warn(result.warnings);
}

void ImportCommand::write_lights(const ImportResult& result) const {
  if (lights_.empty()) {
    if (!result.lights.empty()) program_.say("the file has luminaires: --lights-out FILE writes them");
    return;
  }
  if (result.lights.empty())
    program_.warn({{{},
                    fmt::format("no luminaire in '{}': '{}' is not written", input_, lights_),
                    "`dimdis new … --lights-out` writes lights to begin with"}});
  else
    write_file(lights_, result.lights);
  const std::filesystem::path folder = lights_ == "-" ? "" : std::filesystem::path(lights_).parent_path();
  for (const ImportedFile& file : result.files) {
    const std::string path = (folder / file.name).string();
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && read_text_file(path, kMaxImportBytes) != file.bytes)
      throw IoError(
          path, "is there already and differs from what the model carries; remove it, or write elsewhere");
    write_file(path, file.bytes);
  }
}

bool ImportCommand::is_sound(const std::string& zone) const {
  const std::string name = output_ == "-" ? "<stdout>" : output_;
  Warnings warnings;
  try {
    read_zone(zone, name, {}, 0.0, database_search("", output_), warnings);
  } catch (const InputError& error) {
    // The file is worth having all the same: these are places to be mended by hand.
    program_.warn(one_of_each(warnings));
    program_.warn(error.problems());
    return false;
  }
  if (strict_ && !warnings.empty()) throw InputError(warnings, warnings.size());
  program_.warn(one_of_each(warnings));
  return true;
}

}  // namespace dim
