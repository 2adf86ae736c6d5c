#include <cmath>

#include "base/input_file.hpp"
#include "common/database_option.hpp"
#include "common/option_checks.hpp"
#include "dimdis/options.hpp"
#include "scene/zone_reader.hpp"

namespace dim {

void add_zone_options(CLI::App& app, ZoneInput& input, bool required) {
  auto* zone = app.add_option("ZONE", input.path, "Zone file (TOML), - for standard input")->type_name("");
  if (required) zone->required();
  app.add_option("--set", input.overrides, "Override a value of the zone file: KEY=VALUE, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check(pair_of("KEY=VALUE"))
      ->default_str("")
      ->group("Input");
  app.add_option("--cell", input.cell_m, "Target cell edge, m, in place of the zone file's")
      ->check(number_within(0.0, HUGE_VAL, true))
      ->default_str("")
      ->type_name("SIZE")
      ->group("Input");
  app.add_flag("--strict", input.strict, "Every warning is an error")->group("Input");
  add_database_option(app, input.database);
}

void warn(Program& program, const ZoneInput& input, const Warnings& warnings) {
  if (input.strict && !warnings.empty()) throw InputError(warnings, warnings.size());
  program.warn(warnings);
}

Zone read_zone(Program& program, const ZoneInput& input) {
  constexpr std::size_t kMaxZoneBytes = 64 << 20;
  Warnings warnings;
  const std::string text = read_text_file(input.path, kMaxZoneBytes, program.job());
  Zone zone = read_zone(text, input.path == "-" ? "<stdin>" : input.path, input.overrides, input.cell_m,
                        database_search(input.database, input.path), warnings);
  warn(program, input, warnings);
  check_cells_fit(zone, program.job().memory_limit_bytes);
  return zone;
}

}  // namespace dim
