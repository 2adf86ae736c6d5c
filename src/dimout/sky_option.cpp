#include "dimout/sky_option.hpp"

#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "sky/weather_light.hpp"

namespace dim {
namespace {

struct ToDaylight {
  Daylight operator()(const StandardSky& sky) const { return daylight_of(sky_and_sun_of(sky)); }
  Daylight operator()(const PerezSky& sky) const { return daylight_of(sky_and_sun_of(sky)); }
  Daylight operator()(const WeatherMoment& moment) const {
    return daylight_of(sky_and_sun_of(read_epw(moment.path), moment));
  }
};

}  // namespace

CLI::Option* add_state_option(CLI::App& command, std::vector<std::string>& states) {
  return command
      .add_option("--state", states, "State of a group of windows, repeatable; others stay as the zone has them")
      ->type_name("GROUP=STATE")
      ->allow_extra_args(false)
      ->check(pair_of("GROUP=STATE"))
      ->group("Input");
}

Daylight sky_asked_for(const std::string& spec) {
  return in_file("--sky " + spec, [&] { return std::visit(ToDaylight{}, parse_sky_spec(spec)); });
}

}  // namespace dim
