#include "dimout/daylight.hpp"

#include <fmt/format.h>

#include "climate/sensor_year.hpp"
#include "common/in_file.hpp"
#include "dimout/sky_option.hpp"

namespace dim {

CLI::App* add_daylight_command(Program& program, DaylightInput& input, const std::string& name,
                               const std::string& what, const std::string& example, bool weather_required) {
  auto* command = program.add_command(name, what, "  " + example);
  command
      ->add_option("ROOM.lum", input.database.path,
                   "Luminance database with daylight coefficients, - for standard input")
      ->required(weather_required)
      ->type_name("");
  command->add_option("--weather", input.weather, "EnergyPlus weather file")
      ->required(weather_required)
      ->type_name("FILE.epw")
      ->group("Input");
  add_state_option(*command, input.states);
  command->add_option("-o,--output", input.database.output, "File to write, - for standard output")
      ->type_name("FILE");
  program.add_common_options(*command, name == "annual");
  return command;
}

DaylitRoom::DaylitRoom(Program& program, const DaylightInput& input)
    : database(input.database.path, program.job()),
      states(parse_states(input.states)),
      coefficients(in_file(input.database.path, [&] { return stored_coefficients(database, states); })),
      sun(sun_at_points(database, states)) {
  if (!database.zone().site)
    program.warn({{{input.database.path, 0, 0}, "its zone file has no [site]: +y counts as true north",
                   "give the zone file [site] north"}});
}

std::vector<WindowPart> parts_at(const DaylitRoom& room, const OperatedWindows& windows,
                                 const std::vector<std::size_t>& points) {
  if (!windows.parts.empty()) return at_points(windows.parts, points);
  return {{at_points(room.coefficients, points), at_points(room.sun, points), {}, true}};
}

void say_operated(const Program& program, const std::vector<BlindYear>& blinds, const AnnualSky& sky) {
  for (const auto& blind : blinds) {
    double closed_h = 0.0;
    for (const std::size_t step : sky.lit) closed_h += blind.closed[step] ? sky.step_h : 0.0;
    program.say(fmt::format("windows '{}': '{}' for {:.0f} of {:.0f} h of light", blind.windows, blind.closed_state,
                            closed_h, sky.step_h * static_cast<double>(sky.lit.size())));
  }
}

}  // namespace dim
