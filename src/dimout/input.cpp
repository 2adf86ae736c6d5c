#include "base/atomic_file.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "dimout/commands.hpp"

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

Mix mix_of(const LuminanceDatabase& database, const DatabaseInput& input) {
  return in_file(input.path, [&] { return parse_mix(input.mix, database.sources()); });
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

std::vector<PointSet> chosen_sets(const Zone& zone, const std::string& name, const std::string& path) {
  if (name.empty()) return zone.point_sets;
  std::vector<std::string> names;
  for (const auto& set : zone.point_sets) {
    if (set.name == name) return {set};
    names.push_back(set.name);
  }
  throw InputError({{path, 0, 0}, "no measuring plane or sensors '" + name + "'", name_cure(name, names)});
}

std::vector<std::string> columns_with_source(const DatabaseInput& input, std::vector<std::string> columns) {
  if (input.by_source) columns.insert(columns.begin(), "source");
  return columns;
}

}  // namespace dim
