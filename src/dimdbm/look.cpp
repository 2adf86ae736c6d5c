#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "common/database_option.hpp"
#include "common/json_text.hpp"
#include "database/finish_figures.hpp"
#include "dimdbm/commands.hpp"
#include "dimdbm/entry_lines.hpp"
#include "photometry/text_scanner.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/rendering.hpp"
#include "spectrum/white.hpp"

namespace dim {
namespace {

std::string figure(double value, const char* form) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(form), value);
}

// Safe to print: names and sources may hold anything.
std::string first_line(const std::string& text) { return to_utf8(text.substr(0, text.find('\n'))); }

const char* type_name(PhotometricType type) {
  return type == PhotometricType::kC ? "C" : type == PhotometricType::kB ? "B" : "A";
}

const char* shape_name(OpeningShape shape) {
  static const char* const kNames[] = {"point",           "line",
                                       "rectangle",       "box",
                                       "ellipse",         "vertical cylinder",
                                       "ellipsoid",       "horizontal cylinder",
                                       "vertical ellipse"};
  return kNames[static_cast<std::size_t>(shape)];
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json json_number(double value) {
  return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
}

std::string words_of(const nlohmann::ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (!value.is_array()) return value.is_null() ? "-" : value.dump();
  std::string words;
  for (const auto& one : value) words += (words.empty() ? "" : " x ") + words_of(one);
  return words;
}

std::string lines_of(const nlohmann::ordered_json& json) {
  std::string text;
  for (const auto& [key, value] : json.items()) text += fmt::format("{:<24} {}\n", key, words_of(value));
  return text;
}

// An empty table would not say that there is nothing to look in.
void refuse_no_database(const DatabaseSearch& search) {
  if (search.folders.empty())
    throw InputError({{},
                      "there is no database: neither a folder db/ here nor an installed one",
                      "give one with --db DIR, or install DIM (cmake --install)"});
}

}  // namespace

LookCommands::LookCommands(Program& program) : program_(program) {
  list_ = program.add_command("list", "Every entry with its figures", "  dimdbm list --kind fittings");
  show_ = program.add_command(
      "show", "Everything about an entry, a spectrum or a photometric file",
      "  dimdbm show troffer-3600 --json\n  dimdbm show lamp.ldt\n  dimdbm show led-4000");
  check_ = program.add_command("check", "Looks through every entry: flux, albedo, sources named, files there",
                               "  dimdbm check --db db");
  show_
      ->add_option("ENTRY|FILE", what_,
                   "Entry, spectrum by name, or an .ies, .ldt, .xml or entry's .toml file")
      ->required()
      ->type_name("");
  for (auto* command : {list_, show_, check_}) {
    add_database_option(*command, db_);
    command->add_option("-o,--output", output_, "File to write, - for standard output")->type_name("FILE");
    command->add_flag("--json", json_, "JSON in place of text");
    if (command != show_) {
      command->add_flag("--csv", csv_, "CSV in place of text");
      command->add_option("--kind", kind_, "fittings, surfaces, spectra or all")
          ->check(CLI::IsMember({"all", kFittings, kSurfaces, kSpectra}));
    }
    program.add_common_options(*command);
  }
}

bool LookCommands::run(Exit& status) {
  if (!list_->parsed() && !show_->parsed() && !check_->parsed()) return false;
  if (json_ && csv_) throw UsageError("--json and --csv are two forms of the same table");
  program_.check_output(output_, {what_});
  if (list_->parsed())
    list();
  else if (show_->parsed())
    show();
  else
    status = check();
  return true;
}

void LookCommands::write_table(const Table& table) {
  program_.stage(kWritingStage);
  write_file(output_, json_ ? table.json() : table.csv());
}

void LookCommands::list() {
  const DatabaseSearch search = databases_to_list(db_);
  if (kind_ != kSpectra) refuse_no_database(search);
  const auto entries = entries_of(search, kind_, db_.empty());
  const auto lines = read_lines(entries, search, false);
  if (json_ || csv_) {
    Table table({"name", "kind", "flux_lm", "max_intensity_cd", "watts", "reflectance_or_transmittance",
                 "cct_K", "colour", "source"});
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& l = lines[i];
      table.add({entries[i].name, l.kind, l.flux_lm, l.max_cd, l.watts, l.share, l.cct_K, l.colour,
                 l.problem.empty() ? first_line(l.source) : "unreadable: " + first_line(l.problem)});
    }
    return write_table(table);
  }
  std::size_t longest = 4;
  for (const auto& entry : entries) longest = std::max(longest, entry.name.size());
  std::string text = fmt::format("{:<{}}  {:<8} {:>9} {:>9} {:>7} {:>7} {:>7}  {:<16} {}\n", "name", longest,
                                 "kind", "lm", "cd", "W", "rho,tau", "CCT, K", "colour", "source");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& l = lines[i];
    text +=
        fmt::format("{:<{}}  {:<8} {:>9} {:>9} {:>7} {:>7} {:>7}  {:<16} {}\n", first_line(entries[i].name),
                    longest, l.kind, figure(l.flux_lm, "{:.1f}"), figure(l.max_cd, "{:.1f}"),
                    figure(l.watts, "{:g}"), figure(l.share, "{:.3f}"), figure(l.cct_K, "{:.0f}"), l.colour,
                    l.problem.empty() ? first_line(l.source) : "unreadable: " + first_line(l.problem));
  }
  program_.stage(kWritingStage);
  write_file(output_, text);
}

Exit LookCommands::check() {
  const DatabaseSearch search = databases_to_list(db_);
  refuse_no_database(search);
  const auto entries = entries_of(search, kind_, false);
  const auto lines = read_lines(entries, search, true);
  Table table({"name", "kind", "state", "problem"});
  std::size_t n_bad = 0;
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool good = lines[i].problem.empty();
    if (!good) {
      ++n_bad;
      text += fmt::format("{} {}: {}\n", lines[i].kind, first_line(entries[i].name),
                          first_line(lines[i].problem));
    }
    table.add(
        {entries[i].name, lines[i].kind, std::string(good ? "good" : "bad"), first_line(lines[i].problem)});
  }
  text += fmt::format("{} {}, {} with a problem\n", entries.size(), entries.size() == 1 ? "entry" : "entries",
                      n_bad);
  if (json_ || csv_) {
    write_table(table);
  } else {
    program_.stage(kWritingStage);
    write_file(output_, text);
  }
  return n_bad == 0 ? Exit::done : Exit::check_failed;
}

void LookCommands::show() {
  Warnings warnings;
  const Found found = find_entry_or_file(database_search(db_, "-"), what_, warnings);
  program_.warn(warnings);
  if (const auto* record = found.fitting())
    show_fitting(*record);
  else if (const auto* finish = found.finish())
    show_surface(*finish);
  else
    show_spectrum(*found.spectrum());
}

void LookCommands::show_fitting(const FittingRecord& record) {
  const auto& p = record.photometry;
  const auto& entry = record.entry;
  const auto watts = record.watts();
  nlohmann::ordered_json json = {
      {"name", entry.name},
      {"kind", "fitting"},
      {"title", entry.title},
      {"flux_lm", p.flux_lm},
      {"file_flux_lm", record.file_flux_lm},
      {"declared_flux_lm", json_of(p.declared_flux_lm)},
      {"declared_lamp_flux_lm", json_of(p.declared_lamp_flux_lm)},
      {"lamps", p.n_lamps},
      {"max_intensity_cd", p.max_cd},
      {"photometric_type", type_name(p.distribution.type)},
      {"symmetry", symmetry_name(p.symmetry)},
      {"opening_m", {p.opening.length_m, p.opening.width_m, p.opening.height_m}},
      {"opening_shape", shape_name(p.opening.shape)},
      {"watts", json_of(watts)},
      {"efficacy_lm_W",
       watts && *watts > 0 ? nlohmann::ordered_json(p.flux_lm / *watts) : nlohmann::ordered_json()},
      {"spectrum", spectrum_words(entry)},
      {"cct_K", entry.spectrum ? json_number(cct_of(*entry.spectrum)) : nlohmann::ordered_json()},
      {"lamp_factor", entry.lamp_factor},
      {"maintenance_factor", entry.maintenance_factor},
      {"format", p.format},
      {"manufacturer", p.keyword("MANUFAC")},
      {"catalogue", p.keyword("LUMCAT")},
      {"file", entry.file},
      {"source", entry.source},
      {"licence", entry.licence}};
  program_.stage(kWritingStage);
  write_file(output_, json_ ? json_text(json) : lines_of(json));
}

void LookCommands::show_surface(const Finish& finish) {
  const bool glazing = finish.kind == FinishKind::glazing;
  const Vec3 xyz = finish_xyz(finish, find_spectrum("d65"));
  const Vec2 xy = xy_of(xyz);
  nlohmann::ordered_json json = {{"name", finish.name},
                                 {"kind", glazing ? "glazing" : "opaque"},
                                 {glazing ? "luminous_transmittance" : "luminous_reflectance", xyz.y},
                                 {"specular", finish.specular},
                                 {"roughness", finish.roughness},
                                 {"cie_x", json_number(xy.x)},
                                 {"cie_y", json_number(xy.y)},
                                 {"illuminant", "d65"}};
  program_.stage(kWritingStage);
  write_file(output_, json_ ? json_text(json) : lines_of(json));
}

void LookCommands::show_spectrum(const SpectrumEntry& spectrum) {
  const auto light = light_responses(spectrum.power);
  const auto white = white_point(light.xyz);
  const auto rendering = colour_rendering(light);
  const Vec2 xy = xy_of(light.xyz);
  const auto& points = spectrum.power.points();
  const auto peak = std::max_element(points.begin(), points.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  const nlohmann::ordered_json json = {
      {"name", spectrum.name},
      {"kind", "spectrum"},
      {"title", spectrum.title},
      {"cct_K", json_number(white.cct_K)},
      {"duv", json_number(white.duv)},
      {"ra", json_number(rendering.ra)},
      {"r9", json_number(rendering.r[8])},
      {"cie_x", json_number(xy.x)},
      {"cie_y", json_number(xy.y)},
      {"efficacy_lm_W", kMaxEfficacy_lm_W * light.xyz.y / light.power},
      {"melanopic_der", melanopic_edi_lx(light.melanopic) / (kMaxEfficacy_lm_W * light.xyz.y)},
      {"peak_nm", peak->first},
      {"wavelengths_nm", {points.front().first, points.back().first}},
      {"source", spectrum.source},
      {"licence", spectrum.licence}};
  program_.stage(kWritingStage);
  write_file(output_, json_ ? json_text(json) : lines_of(json));
}

}  // namespace dim
