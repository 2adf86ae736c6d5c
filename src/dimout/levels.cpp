#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/input_file.hpp"
#include "climate/metrics.hpp"
#include "climate/sensor_year.hpp"
#include "common/in_file.hpp"
#include "common/option_checks.hpp"
#include "dimout/daylight.hpp"
#include "dimout/esp_export.hpp"
#include "esp/level_file.hpp"
#include "sky/direction.hpp"
#include "sky/weather_light.hpp"

namespace dim {
namespace {

MonthDay month_day(const std::string& option, const std::string& text) {
  return in_file(option, [&] { return parse_month_day(text); });
}

/// Files of presence lie beside the control file.
std::string beside(const std::string& file, const std::string& name) {
  return (std::filesystem::path(file).parent_path() / name).string();
}

}  // namespace

struct LevelsCommand::Room : DaylitRoom {
  Room(Program& program, const DaylightInput& input, const std::string& control,
       const std::vector<std::string>& set)
      : DaylitRoom(program, input),
        plan(read_control(read_text_file(control, kMostControlBytes), name_for_messages(control), set)),
        sensors(sensors_of(plan, database.zone())) {
    if (plan.circuits.empty())
      throw InputError(Problem{{name_for_messages(control), 1, 1},
                               "the file has no circuit, whose sensors would be measured",
                               "write at least one [[circuit]]"});
  }

  ControlPlan plan;
  ControlSensors sensors;
};

OperatedWindows LevelsCommand::operate(const Room& room, const AnnualSky& sky, const Job& job) {
  if (room.plan.blinds.empty()) return {};
  return dim::operate(room.database, room.states, room.plan.blinds, sky, job);
}

LevelsCommand::LevelsCommand(Program& program) : program_(program) {
  levels_ = add_daylight_command(
      program, input_, "levels", "Daylight at control sensors, what lamps do about it, files for ESP-r",
      "dimout levels room.lum --weather denver.epw --control control.toml -o room.levels.csv", false);
  levels_->add_option("--control", control_, "Circuits, sensors, control laws and occupancy")
      ->type_name("FILE.toml")
      ->group("Input");
  levels_->add_option("--set", set_, "Replace a value of the control file, repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check(pair_of("KEY=VALUE"))
      ->group("Input");
  levels_->add_option("--method", method_, "How sensors get their daylight")
      ->check(CLI::IsMember({"daylight-coefficients", "paper"}));
  levels_->add_option("--from", from_, "First day")->type_name("MM-DD");
  levels_->add_option("--to", to_, "Last day")->type_name("MM-DD");
  levels_
      ->add_option("--steps-per-hour", steps_per_hour_,
                   "Steps an hour; those of the weather file unless said")
      ->check(CLI::Range(1, 60));
  levels_
      ->add_option(
          "--at", at_,
          "One moment: altitude and azimuth of the sun in degrees, direct normal and diffuse horizontal W/m2")
      ->expected(4)
      ->type_name("ALT AZI IDN IDH");
  levels_
      ->add_option("--format", format_,
                   "csv: zone lighting levels; tdf, cgc: temporal file and casual gain control of ESP-r")
      ->check(CLI::IsMember({"csv", "tdf", "cgc"}));
  levels_
      ->add_option("--check", check_,
                   "Read a .tdfa or .cgc file as strictly as ESP-r's limits ask, and do nothing else")
      ->type_name("FILE")
      ->group("ESP-r");
  levels_
      ->add_option("--esp-zone", esp_.zone,
                   "Name of the zone in the ESP-r model; that of the DIM zone unless said")
      ->group("ESP-r");
  levels_->add_option("--convective", esp_.convective, "Convective share of the lamps' heat (tdf)")
      ->check(number_within(0.0, 1.0))
      ->group("ESP-r");
  levels_
      ->add_option(
          "--gains", esp_.gains_file,
          "Gains of occupants and equipment, six watts a step: convective, radiant, latent of each (tdf)")
      ->type_name("FILE.csv")
      ->group("ESP-r");
  levels_->add_option("--esp-year", esp_.year, "Year of the ESP-r model (tdf)")
      ->check(CLI::Range(1900, 2200))
      ->group("ESP-r");
  levels_
      ->add_option("--sensor-type", esp_.sensor_type, "2: daylight factors; 5: daylight coefficients (cgc)")
      ->check(CLI::IsMember({2, 5}))
      ->group("ESP-r");
  levels_
      ->add_option("--second-state", esp_.second_states,
                   "States of windows with ESP-r's blind drawn, repeatable (cgc, type 5)")
      ->type_name("GROUP=STATE")
      ->allow_extra_args(false)
      ->check(pair_of("GROUP=STATE"))
      ->group("ESP-r");
  levels_
      ->add_option("--esp-surface", esp_.surfaces,
                   "Surface of the ESP-r zone that a group of windows is, from 1 (cgc, type 2)")
      ->type_name("GROUP=NUMBER")
      ->allow_extra_args(false)
      ->check(pair_of("GROUP=NUMBER"))
      ->group("ESP-r");
  levels_
      ->add_option("--esp-r-workaround", esp_.workaround_surface,
                   "Put an inert vertical sensor on this outside surface first: ESP-r 13 reads 0 lx of type "
                   "5 without one (cgc)")
      ->type_name("SURFACE")
      ->check(CLI::Range(1, 100))
      ->group("ESP-r");
}

bool LevelsCommand::run() {
  if (!levels_->parsed()) return false;
  if (!check_.empty()) {
    check();
    return true;
  }
  if (input_.database.path.empty()) throw UsageError("levels: ROOM.lum is required");
  if (control_.empty()) throw UsageError("levels: --control is required");
  if (at_.empty() && input_.weather.empty()) throw UsageError("levels: --weather or --at is required");
  program_.check_output(input_.database.output, {input_.database.path, input_.weather, control_});
  if (at_.empty())
    levels();
  else
    at_moment();
  return true;
}

void LevelsCommand::check() const {
  const std::string text = read_text_file(check_, kMostControlBytes), name = name_for_messages(check_);
  program_.say(fmt::format("{}: {}", name, checked_esp_file(text, name)));
}

Weather LevelsCommand::weather() {
  Weather weather = read_epw(input_.weather, program_.job());
  program_.warn(weather.warnings);
  program_.warn(beam_without_sun(weather, name_for_messages(input_.weather)));
  const int per_hour = static_cast<int>(std::lround(1.0 / weather.step_h));
  if (steps_per_hour_ % per_hour != 0)
    throw UsageError(fmt::format("--steps-per-hour {}: the weather has {} an hour, give a multiple",
                                 steps_per_hour_, per_hour));
  if (steps_per_hour_ > per_hour) weather = subdivided(weather, steps_per_hour_ / per_hour);
  if (!from_.empty() || !to_.empty()) {
    const MonthDay first = from_.empty() ? MonthDay{1, 1} : month_day("--from", from_);
    const MonthDay last = to_.empty() ? MonthDay{12, 31} : month_day("--to", to_);
    weather = between(weather, first.month, first.day, last.month, last.day);
    if (weather.steps.empty())
      throw InputError(Problem{{input_.weather}, "holds no step from --from to --to", ""});
  }
  return weather;
}

LevelsCommand::Sensed LevelsCommand::sensed(const Room& room, const Weather& weather) {
  if (method_ == "paper") {
    if (!room.plan.blinds.empty())
      throw UsageError("--method paper: it knows no windows that change, leave [[blind]] out of the control file");
    const auto coefficients = at_points(room.coefficients, room.sensors.points);
    return {paper_sensor_years(room.sensors.names, weather, daylight_factors(coefficients),
                               at_points(room.sun, room.sensors.points)),
            {}};
  }
  const auto sky = annual_sky(weather, room.coefficients.subdivision, room.coefficients.ground_reflectance,
                              program_.job());
  auto windows = operate(room, sky, program_.job());
  say_operated(program_, windows.blinds, sky);
  return {sensor_years(room.sensors.names, sky, parts_at(room, windows, room.sensors.points), program_.job()),
          std::move(windows.blinds)};
}

void LevelsCommand::at_moment() {
  const Room room(program_, input_, control_, set_);
  if (!(at_[0] >= -90.0 && at_[0] <= 90.0))
    throw UsageError(fmt::format("--at: altitude {} is outside -90..90", at_[0]));
  if (!(at_[2] >= 0.0 && at_[3] >= 0.0)) throw UsageError("--at: irradiances are at least 0");
  if (at_[0] <= 0.0 && at_[2] > 0.0)
    program_.warn({{{"--at"}, fmt::format("the sun stands {} degrees above the horizon: its beam is left out", at_[0]),
                    ""}});
  const auto light = perez_sky_and_sun(sky_direction(radians(at_[0]), radians(at_[1])), {at_[2], at_[3]});
  const auto sky = sky_of_moment(light, room.coefficients.subdivision, room.coefficients.ground_reflectance,
                                 {at_[2], at_[3]});
  const auto windows = operate(room, sky, program_.job());
  const auto years = sensor_years(room.sensors.names, sky, parts_at(room, windows, room.sensors.points));
  Table table({"circuit", "sensor", "sun_lx", "sky_lx", "total_lx"});
  for (const auto& circuit : room.plan.circuits) {
    ControlPlan alone;
    alone.circuits = {circuit};
    for (const auto& name : sensors_of(alone, room.database.zone()).names)
      for (const auto& year : years)
        if (year.name == name)
          table.add({circuit.name, name, static_cast<double>(year.sun_lx[0]),
                     static_cast<double>(year.sky_lx[0]), year.total_lx(0)});
  }
  write_table(program_, table, input_.database);
}

void LevelsCommand::levels() {
  program_.stage("read");
  const Room room(program_, input_, control_, set_);
  const Weather weather = this->weather();
  const auto circuits = circuits_of(
      room.plan, room.sensors, room.database, weather,
      [&](const std::string& name) { return read_text_file(beside(control_, name), kMostControlBytes); });
  const EspExport esp(esp_, room.plan, room.sensors, circuits, room.database, input_.database.path);
  if (format_ == "cgc") {
    program_.stage(kWritingStage);
    return write_file(input_.database.output, esp.gain_control(room.states, input_.states));
  }
  program_.stage("year");
  auto [years, blinds] = sensed(room, weather);
  const auto lamps = run_circuits(circuits, years, weather.steps.size());
  say_energy(room, circuits, lamps, weather);
  program_.stage(kWritingStage);
  if (format_ == "tdf") {
    const TemporalGains gains = esp.temporal_gains(weather, lamps);
    write_file(input_.database.output, write_tdf(gains));
    if (esp_.gains_file.empty())
      program_.say("occupants and equipment: 0 W; this file replaces all casual gains of the zone");
    const auto name = std::filesystem::path(input_.database.output).filename().string();
    program_.say("lines for the model's .cfg:\n" + tdf_links(gains, name == "-" ? "room.tdfa" : name));
    return;
  }
  ZoneLightingLevels file;
  file.about = {{"zone", room.database.zone().name},
                {"luminance database",
                 fmt::format("{} ({})", name_for_messages(input_.database.path), room.database.hash())},
                {"weather", fmt::format("{} ({})", name_for_messages(input_.weather), weather.place)},
                {"method", method_},
                {"time", "end of step, local standard time"}};
  for (const auto& [group, state] : room.states) file.about.emplace_back("state of " + group, state);
  for (const auto& step : weather.steps) {
    const SunPosition sun = sun_of(weather, step);
    file.steps.push_back({step.end, degrees(sun.apparent_altitude_rad), degrees(sun.azimuth_rad),
                          step.irradiance.direct_normal_W_m2, step.irradiance.diffuse_horizontal_W_m2});
  }
  file.sensors = std::move(years);
  file.blinds = std::move(blinds);
  file.circuits = lamps;
  for (const auto& circuit : circuits) file.circuit_names.push_back(circuit.name);
  write_file(input_.database.output, write_levels(file));
}

void LevelsCommand::say_energy(const Room& room, const std::vector<Circuit>& circuits,
                               const std::vector<CircuitYear>& years, const Weather& weather) const {
  std::vector<CircuitEnergy> energies;
  for (std::size_t c = 0; c < circuits.size(); ++c) {
    energies.push_back(energy_of(circuits[c], years[c], weather.step_h));
    const auto& energy = energies.back();
    program_.say(
        fmt::format("circuit {}: {:.1f} kWh, {:.0f} % of {:.1f} kWh without control; standby {:.1f} kWh",
                    circuits[c].name, energy.lamps_kWh,
                    energy.uncontrolled_kWh > 0.0 ? 100.0 * energy.lamps_kWh / energy.uncontrolled_kWh : 0.0,
                    energy.uncontrolled_kWh, energy.standby_kWh));
  }
  constexpr double kYear_h = 8760.0;
  const double area_m2 = room.plan.area_m2.value_or(floor_area_m2(room.database.zone()));
  if (static_cast<double>(weather.steps.size()) * weather.step_h >= kYear_h - 1e-6 && area_m2 > 0.0)
    program_.say(
        fmt::format("LENI: {:.2f} kWh/m2 a year on {:.1f} m2", leni_kWh_m2(energies, area_m2), area_m2));
}

}  // namespace dim
