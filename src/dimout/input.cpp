#include <algorithm>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "climate/sky_mix.hpp"
#include "common/database_option.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "database/spectrum_entry.hpp"
#include "database/spectrum_text.hpp"
#include "dimout/commands.hpp"
#include "dimout/sky_option.hpp"
#include "transport/auto_bands.hpp"

namespace dim {

CLI::App* add_command(Program& program, DatabaseInput& input, const std::string& name,
                      const std::string& what, const std::string& example) {
  auto* command = program.add_command(name, what, "  " + example);
  command->add_option("ROOM.lum", input.path, "Luminance database, - for standard input")
      ->required()
      ->type_name("");
  command
      ->add_option("--mix", input.mix, "Factor on a source or a group of sources, repeatable; others stay 1")
      ->type_name("NAME=FACTOR")
      ->allow_extra_args(false)
      ->check(pair_with_factor("NAME=FACTOR"))
      ->default_str("")
      ->group("Input");
  command
      ->add_option("--spectrum", input.spectra,
                   "Another spectrum for a source or a group: a name (led-4000), [[nm, value], ...] or a file "
                   "(.csv, .txt, .spdx, .xml); repeatable")
      ->type_name("NAME=SPECTRUM")
      ->allow_extra_args(false)
      ->check(pair_of("NAME=SPECTRUM"))
      ->default_str("")
      ->group("Input");
  add_state_option(*command, input.states)->default_str("");
  command
      ->add_option("--sky", input.sky,
                   "Sky for daylight coefficients: cie-overcast:LUX, cie-N:LUX@ALTITUDE,AZIMUTH, uniform:LUX, "
                   "perez:ALTITUDE,AZIMUTH,IDN,IDH or FILE.epw@MM-DDTHH:MM")
      ->type_name("SPEC")
      ->default_str("")
      ->group("Input");
  program.add_common_options(*command, name == "grid");
  return command;
}

void add_table_options(CLI::App& command, DatabaseInput& input, bool by_source) {
  command.add_option("-o,--output", input.output, "File to write, - for standard output")->type_name("FILE");
  command.add_flag("--json", input.json, "JSON in place of CSV");
  if (by_source)
    command
        .add_option_function<std::string>(
            "--by", [&input](const std::string&) { input.by_source = true; },
            "Each source apart: --by source")
        ->check(CLI::IsMember({"source"}));
}

namespace {

// A curve written out, a file as `dimdbm add` reads them, or a name.
SpectralCurve spectrum_given(const std::string& text, const DatabaseSearch& search) {
  constexpr std::size_t kMostBytes = 64 << 20;
  if (text.starts_with('[')) return read_spectrum_text(text);
  for (const std::string_view ending : {".csv", ".txt", ".spdx", ".xml"}) {
    if (text.ends_with(ending)) return read_lamp_spectrum(read_text_file(text, kMostBytes), text).power;
  }
  return spectrum_finder(search)(text);
}

void set_spectra(LuminanceDatabase& database, const DatabaseInput& input) {
  const DatabaseSearch search = database_search("", input.path);
  for (const auto& text : input.spectra) {
    const auto equals = text.find('=');
    const auto sources = sources_named(text.substr(0, equals), database.sources(), "--spectrum");
    const SpectralCurve curve = in_file("--spectrum " + text, [&] { return spectrum_given(text.substr(equals + 1), search); });
    for (const std::size_t s : sources) database.set_spectrum(s, curve);
  }
}

// Bands that were right for the lamps' own spectra may not be for others.
Warnings too_few_bands(const LuminanceDatabase& database) {
  LampSpectra lamps;
  for (std::size_t s = 0; s < database.sources().size(); ++s) {
    lamps.spectra.push_back(database.spectra()[s].curve);
    lamps.flux_lm.push_back(database.sources()[s].flux_lm);
  }
  const BandChoice choice = judged_bands(database.zone(), lamps, database.bands());
  if (choice.is_enough()) return {};
  return {{{},
           "--spectrum: with these spectra " + in_words(choice),
           "for better figures run dimray --bands auto with the spectra in the lights file"}};
}

}  // namespace

LuminanceDatabase open_database(Program& program, const DatabaseInput& input) {
  LuminanceDatabase database(input.path, program.job());
  if (input.spectra.empty()) return database;
  in_file(input.path, [&] { set_spectra(database, input); });
  program.warn(too_few_bands(database));
  return database;
}

Mix mix_of(const LuminanceDatabase& database, const DatabaseInput& input) {
  return in_file(input.path, [&] {
    Mix mix = parse_mix(input.mix, database.sources());
    put_into_states(input.states, database.sources(), mix);
    return input.sky.empty() ? even_patches(database, mix) : sky_mix(database, mix, sky_asked_for(input.sky));
  });
}

double outside_lx(const LuminanceDatabase& database, DatabaseInput& input) {
  if (!database.sky())
    throw InputError({{input.path, 0, 0}, "holds no daylight: there is no daylight factor",
                      "run dimray with a [sky] in the lights file"});
  const bool coefficients = database.sky()->subdivision > 0;
  if (coefficients && input.sky.empty()) input.sky = "cie-overcast:10000";
  const double lx = input.sky.empty() ? database.sky()->horizontal_lx : sky_asked_for(input.sky).sky.horizontal_lx();
  if (!(lx > 0.0))
    throw InputError({{input.path, 0, 0}, "the sky is black: there is no daylight factor", "take a sky with light"});
  return lx;
}

void for_sources(const LuminanceDatabase& database, const DatabaseInput& input,
                 const std::function<void(const std::string& source, const Mix& mix)>& each) {
  const Mix mix = mix_of(database, input);
  if (!input.by_source) {
    each("", mix);
    return;
  }
  for (std::size_t s = 0; s < mix.size(); ++s) each(database.sources()[s].name, only(mix, s));
}

void write_table(Program& program, const Table& table, const DatabaseInput& input) {
  program.stage(kWritingStage);
  write_file(input.output, input.json ? table.json() : table.csv());
}

std::vector<Table::Value> row_with_source(const std::string& source, std::vector<Table::Value> values) {
  if (!source.empty()) values.insert(values.begin(), source);
  return values;
}

CLI::Option* add_plane_option(CLI::App& command, std::vector<std::string>& planes) {
  return command.add_option("--plane", planes, "Only this measuring plane or sensor group; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->default_str("");
}

std::vector<PointSet> chosen_sets(const Zone& zone, const std::vector<std::string>& names, const std::string& path) {
  if (names.empty()) return zone.point_sets;
  std::vector<PointSet> chosen;
  for (const auto& name : names) {
    const auto set = std::find_if(zone.point_sets.begin(), zone.point_sets.end(),
                                  [&](const PointSet& other) { return other.name == name; });
    if (set == zone.point_sets.end()) {
      std::vector<std::string> known;
      for (const auto& other : zone.point_sets) known.push_back(other.name);
      throw InputError({{path, 0, 0}, "no measuring plane or sensors '" + name + "'", name_cure(name, known)});
    }
    chosen.push_back(*set);
  }
  return chosen;
}

std::vector<PointSet> planar_sets(const Zone& zone, const std::vector<std::string>& names, const std::string& path,
                                  const std::string& what) {
  auto sets = chosen_sets(zone, names, path);
  const auto other = [&](const PointSet& set) { return quantity_of(zone, set) != Quantity::planar; };
  const auto refused = std::find_if(sets.begin(), sets.end(), other);
  if (refused == sets.end()) return sets;
  if (!names.empty())
    throw InputError({{path, 0, 0},
                      fmt::format("'{}' measures {} illuminance, {} is of planar illuminance", refused->name,
                                  quantity_word(quantity_of(zone, *refused)), what),
                      "choose another with --plane"});
  std::erase_if(sets, other);
  return sets;
}

std::vector<std::string> columns_with_source(const DatabaseInput& input, std::vector<std::string> columns) {
  if (input.by_source) columns.insert(columns.begin(), "source");
  return columns;
}

}  // namespace dim
