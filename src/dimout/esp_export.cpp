#include "dimout/esp_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/input_file.hpp"
#include "climate/metrics.hpp"
#include "climate/sensor_year.hpp"
#include "common/in_file.hpp"

namespace dim {
namespace {

constexpr std::size_t kMostGainsBytes = 256 << 20;
constexpr int kLightsSlot = 2;
constexpr std::size_t kDayTypes = 3;  ///< weekdays, Saturday, Sunday
constexpr std::size_t kGivenGains = 6;
constexpr std::size_t kGivenColumn[kGivenGains] = {0, 1, 2, 6, 7, 8};

/// Gains of occupants and equipment at every step: the last six fields of a row, a header row first or none.
void add_given_gains(const std::string& path, std::vector<GainRow>& rows) {
  std::istringstream text(read_text_file(path, kMostGainsBytes));
  std::size_t n = 0;
  int line = 0;
  for (std::string row; std::getline(text, row);) {
    ++line;
    std::vector<double> values;
    std::istringstream fields(row);
    for (std::string field; std::getline(fields, field, ',');) {
      double value = 0.0;
      const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
      if (error == std::errc{} && stop != field.data()) values.push_back(value);
    }
    if (values.size() < kGivenGains) {
      if (n == 0 && line == 1) continue;
      throw InputError(
          Problem{{path, line}, fmt::format("{} watts where {} are needed", values.size(), kGivenGains), ""});
    }
    if (n == rows.size())
      throw InputError(Problem{{path, line}, fmt::format("more rows than the {} steps", n), ""});
    for (std::size_t k = 0; k < kGivenGains; ++k)
      rows[n][kGivenColumn[k]] = values[values.size() - kGivenGains + k];
    ++n;
  }
  if (n != rows.size())
    throw InputError(Problem{{path}, fmt::format("{} rows for {} steps", n, rows.size()), ""});
}

/// Surface number of a group of windows.
int surface_of(const std::string& group, const EspOptions& options) {
  for (const auto& text : options.surfaces) {
    const auto equals = text.rfind('=');
    if (text.substr(0, equals) != group) continue;
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, number);
    if (error == std::errc{} && stop == end && number >= 1) return number;
    throw InputError(Problem{{}, fmt::format("--esp-surface '{}': not the number of a surface", text), ""});
  }
  throw InputError(
      Problem{{},
              fmt::format("which surface of the ESP-r zone the windows '{}' are is not said", group),
              fmt::format("--esp-surface \"{}=7\"", group)});
}

/// What ESP-r multiplies by the patch's luminance and 2 pi/145.
std::vector<double> esp_coefficients(const DaylightCoefficients& c, std::size_t point) {
  std::vector<double> values(kEspPatches);
  for (std::size_t p = 0; p < kEspPatches; ++p)
    values[p] =
        std::min(1.0, static_cast<double>(c.total_lx[p * c.n_points + point]) / (2.0 * kPi / kEspPatches));
  return values;
}

/// A limit of ESP-r that a circuit exceeds becomes a complaint about its place in the control file.
template <typename Work>
auto within_limits(const CircuitPlan& circuit, const Work& work) {
  try {
    return work();
  } catch (const LimitError& error) {
    throw InputError(Problem{circuit.place, fmt::format("circuit '{}': {}", circuit.name, error.what()), ""});
  }
}

}  // namespace

EspExport::EspExport(const EspOptions& options, const ControlPlan& plan, const ControlSensors& sensors,
                     const std::vector<Circuit>& circuits, const LuminanceDatabase& database,
                     const std::string& lum)
    : options_(options),
      plan_(plan),
      sensors_(sensors),
      circuits_(circuits),
      database_(database),
      lum_(lum) {}

std::string EspExport::zone_name() const {
  return options_.zone.empty() ? database_.zone().name : options_.zone;
}

TemporalGains EspExport::temporal_gains(const Weather& weather, const std::vector<CircuitYear>& years) const {
  TemporalGains gains;
  gains.zone = zone_name();
  gains.tag = gains_tag(gains.zone);
  gains.steps_per_hour = static_cast<int>(std::lround(1.0 / weather.step_h));
  const LocalTime &first = weather.steps.front().end, &last = weather.steps.back().end;
  gains.year = options_.year > 0 ? options_.year : first.year;
  // Days are counted as the weather has them, whatever year its months are from.
  const auto n_days =
      static_cast<int>(std::lround(static_cast<double>(weather.steps.size()) * weather.step_h / 24.0));
  gains.begin_day = day_of_year(2001, first.month, first.day);
  gains.end_day = gains.begin_day + n_days - 1;
  if (gains.end_day > 366)
    throw InputError(
        Problem{{}, fmt::format("days {}-{} to {}-{} run over the new year, ESP-r's temporal file does not",
                                first.month, first.day, last.month, last.day), "--from 01-01 --to 12-31"});
  gains.rows.assign(weather.steps.size(), GainRow{});
  if (!options_.gains_file.empty()) add_given_gains(options_.gains_file, gains.rows);
  for (std::size_t i = 0; i < gains.rows.size(); ++i) {
    double watts = 0.0;
    for (std::size_t c = 0; c < years.size(); ++c) watts += years[c].watts[i] + circuits_[c].standby_W;
    gains.rows[i][lights_convective] = watts * options_.convective;
    gains.rows[i][lights_radiant] = watts * (1.0 - options_.convective);
  }
  return gains;
}

EspLightingZone EspExport::lighting_zone(std::size_t circuit) const {
  const ControlSettings& s = circuits_[circuit].settings;
  if (s.law == Law::occupancy)
    throw LimitError("ESP-r has no control law 'occupancy'");
  double watts = 0.0;
  for (const auto& c : circuits_) watts += c.watts;
  EspLightingZone zone;
  zone.setpoint_lx = s.setpoint_lx;
  zone.switch_off = s.switch_off;
  zone.min_light = s.min_light;
  zone.min_power = s.min_power;
  zone.delay_steps = s.delay_steps;
  zone.share = watts > 0.0 ? circuits_[circuit].watts / watts : 0.0;
  zone.law = static_cast<int>(s.law);
  zone.night_lx = s.night_lx;
  zone.slope_per_lx = s.slope_per_lx;
  zone.type = static_cast<EspSensorType>(options_.sensor_type);
  for (const std::size_t sensor : circuits_[circuit].sensors) {
    const MeasuringPoint& point = database_.zone().points[sensors_.points[sensor]];
    zone.sensors.push_back({point.position + database_.zone().origin_m, point.normal, 0, {}});
  }
  return zone;
}

std::string EspExport::gain_control(const WindowStates& states,
                                    const std::vector<std::string>& state_texts) const {
  CasualGainControl control;
  control.description = fmt::format("DIM daylight {}, zone {}",
                                    options_.sensor_type == 5 ? "coefficients" : "factors", zone_name());
  const Schedule& schedule = plan_.circuits.front().occupancy.schedule;
  const bool weekday =
      std::any_of(schedule.days.begin(), schedule.days.begin() + 5, [](bool used) { return used; });
  const bool used[kDayTypes] = {weekday, schedule.days[5], schedule.days[6]};
  for (const bool day : used) {
    control.slots.push_back(day ? kLightsSlot : 0);
    control.active_hours.emplace_back(day ? static_cast<int>(std::floor(schedule.from_h)) : 0,
                                      day ? static_cast<int>(std::ceil(schedule.to_h)) : 1);
  }
  for (std::size_t c = 0; c < circuits_.size(); ++c) 
    control.zones.push_back(within_limits(plan_.circuits[c], [&] { return lighting_zone(c); }));
  // Two decimals are written: the last takes what rounding leaves.
  double rest = 1.0;
  for (std::size_t c = 0; c + 1 < circuits_.size(); ++c) {
    control.zones[c].share = std::round(100.0 * control.zones[c].share) / 100.0;
    rest -= control.zones[c].share;
  }
  control.zones.back().share = rest;
  if (options_.sensor_type == 5)
    add_coefficients(states, state_texts, control);
  else
    add_factors(states, control);
  for (std::size_t c = 0; c < circuits_.size(); ++c)
    within_limits(plan_.circuits[c], [&] { check_lighting_zone(control.zones[c]); });
  return within_limits(plan_.circuits.back(), [&] { return write_cgc(control); });
}

void EspExport::add_coefficients(const WindowStates& states, const std::vector<std::string>& state_texts,
                                 CasualGainControl& control) const {
  std::vector<DaylightCoefficients> stages = {
      in_file(lum_, [&] { return stored_coefficients(database_, states); })};
  if (stages[0].subdivision != 1)
    throw InputError(Problem{
        {lum_}, "has a subdivided sky, ESP-r knows 145 patches", "run dimray with model = \"tregenza\""});
  if (!options_.second_states.empty()) {
    auto texts = state_texts;
    texts.insert(texts.end(), options_.second_states.begin(), options_.second_states.end());
    stages.push_back(in_file(lum_, [&] { return stored_coefficients(database_, parse_states(texts)); }));
  }
  int set = 0;
  for (std::size_t c = 0; c < circuits_.size(); ++c)
    for (std::size_t k = 0; k < circuits_[c].sensors.size(); ++k) {
      EspSensor& sensor = control.zones[c].sensors[k];
      sensor.set = ++set;
      for (const auto& stage : stages)
        sensor.stages.push_back(esp_coefficients(stage, sensors_.points[circuits_[c].sensors[k]]));
    }
  if (options_.workaround_surface == 0) return;
  EspLightingZone inert;
  inert.share = 0.0;
  inert.type = EspSensorType::external;
  inert.law = 0;
  inert.external_surface = options_.workaround_surface;
  inert.sensors.resize(1);
  control.zones.insert(control.zones.begin(), inert);
  control.comments = {
      "Lighting zone 1 is an inert vertical sensor outside, which controls no part of the gain:",
      "ESP-r 13 reads 0 lx of daylight coefficients unless one stands first."};
}

void EspExport::add_factors(const WindowStates& states, CasualGainControl& control) const {
  for (const auto& group : window_groups(database_)) {
    const int surface = surface_of(group, options_);
    const double transmittance = group_transmittance(database_, group, states);
    const auto coefficients = in_file(lum_, [&] { return stored_coefficients(database_, states, {group}); });
    const auto factors = daylight_factors(at_points(coefficients, sensors_.points));
    for (std::size_t c = 0; c < circuits_.size(); ++c) {
      EspWindow window{surface, {}};
      for (const std::size_t sensor : circuits_[c].sensors)
        window.factors.push_back(transmittance > 0.0 ? factors[sensor] / transmittance : 0.0);
      control.zones[c].windows.push_back(window);
    }
  }
}

std::string checked_esp_file(const std::string& text, const std::string& file) {
  if (text.starts_with("ASCIITDF")) {
    const auto gains = read_tdf(text, file);
    return fmt::format("a temporal file of zone {}, days {}..{}, {} steps an hour: as ESP-r reads it",
                       gains.zone, gains.begin_day, gains.end_day, gains.steps_per_hour);
  }
  if (!text.starts_with("*Casual_gain_ctl"))
    throw InputError(Problem{
        {file, 1}, "neither a temporal file (ASCIITDF3) nor a casual gain control (*Casual_gain_ctl)", ""});
  const auto control = read_cgc(text, file);
  return fmt::format("a casual gain control of {} lighting zone{}: as ESP-r reads it", control.zones.size(),
                     control.zones.size() == 1 ? "" : "s");
}

}  // namespace dim
