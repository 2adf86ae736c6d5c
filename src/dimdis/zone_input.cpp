#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "dimdis/options.hpp"
#include "scene/zone_reader.hpp"

namespace dim {

void add_zone_options(CLI::App& app, ZoneInput& input, bool required) {
  auto* zone = app.add_option("ZONE", input.path, "Zone file (TOML), - for standard input")->type_name("");
  if (required) zone->required();
  app.add_option("--set", input.overrides, "Override a value of the zone file: KEY=VALUE, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group("Input");
  app.add_option("--cell", input.cell_m, "Target cell edge, m, in place of the zone file's")
      ->check(CLI::PositiveNumber)
      ->type_name("SIZE")
      ->group("Input");
  add_database_option(app, input.database);
}

Zone read_zone(Program& program, const ZoneInput& input) {
  constexpr std::size_t kMaxZoneBytes = 64 << 20;
  Warnings warnings;
  const std::string text = read_text_file(input.path, kMaxZoneBytes, program.job());
  Zone zone = read_zone(text, input.path == "-" ? "<stdin>" : input.path, input.overrides, input.cell_m,
                        database_search(input.database, input.path), warnings);
  program.warn(warnings);
  return zone;
}

}  // namespace dim
