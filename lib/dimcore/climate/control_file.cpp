#include "climate/control_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "database/toml_reader.hpp"

namespace dim {
namespace {

constexpr NumberRange kLux{0.0, 1e6, true, false};
constexpr NumberRange kMinLight{0.0, 1.0, false, true, true};
constexpr NumberRange kSwitchOff{1.0, 1e3};
constexpr NumberRange kNegative{-1e6, 0.0, false, true};
constexpr NumberRange kHoldOn_min{0.0, 24.0 * 60.0};
constexpr int kLongestDelay = 10000;

/// What `read` makes of a text; a complaint of its own becomes one of the key.
template <typename Read>
void read_text(const TomlTable& table, std::string_view key, const Read& read) {
  const auto text = table.text(key);
  if (!text) return;
  try {
    read(*text);
  } catch (const InputError& error) {
    table.problem(key, error.problems().front().what, error.problems().front().cure);
  }
}

void read_days(const TomlTable& table, Schedule& schedule) {
  static const std::vector<std::string> kDays = {"mon", "tue", "wed", "thu", "fri", "sat", "sun"};
  const auto days = table.texts("days");
  if (!days) return;
  schedule.days.fill(false);
  for (const auto& day : *days) {
    const auto at = std::find(kDays.begin(), kDays.end(), day);
    if (at == kDays.end())
      table.problem("days", fmt::format("no day is called '{}'", day), name_cure(day, kDays));
    else
      schedule.days[static_cast<std::size_t>(at - kDays.begin())] = true;
  }
}

OccupancyPlan read_occupancy(const TomlTable& table, OccupancyPlan plan) {
  plan.place = table.place();
  if (table.has("hours") && table.has("presence"))
    table.problem("presence", "hours and presence are both said", "keep one of them");
  read_text(table, "hours", [&](const std::string& text) {
    const Schedule hours = parse_hours(text);
    plan.schedule.from_h = hours.from_h;
    plan.schedule.to_h = hours.to_h;
    plan.presence_file.clear();
  });
  read_text(table, "presence", [&](const std::string& text) { plan.presence_file = text; });
  read_text(table, "summer_time",
            [&](const std::string& text) { plan.schedule.summer_time = parse_summer_time(text); });
  read_days(table, plan.schedule);
  plan.hold_on_h = table.number_or("hold_on", kHoldOn_min, 60.0 * plan.hold_on_h) / 60.0;
  table.refuse_unknown();
  return plan;
}

void read_settings(const TomlTable& table, ControlSettings& s) {
  if (table.require("law",
                    "one of on, off, on-off, step, dimming, hunt, integral-reset, closed-loop, occupancy"))
    if (const auto word = table.word("law", law_words())) s.law = *law_of(*word);
  s.setpoint_lx = table.number_or("setpoint", kLux, s.setpoint_lx);
  s.switch_off = table.number_or("switch_off", kSwitchOff, s.switch_off);
  s.min_light = table.number_or("min_light", kMinLight, s.min_light);
  s.min_power = table.number_or("min_power", kFraction, s.min_power);
  s.delay_steps = table.integer("delay", 0, kLongestDelay).value_or(s.delay_steps);
  const bool looped = s.law == Law::integral_reset || s.law == Law::closed_loop;
  if (looped) table.require("night", "the sensor's illuminance by the lamps alone, lx");
  s.night_lx = table.number_or("night", kLux, s.night_lx);
  if (s.law == Law::closed_loop) table.require("slope", "per lx, negative");
  s.slope_per_lx = table.number_or("slope", kNegative, s.slope_per_lx);
  s.seed = static_cast<std::uint64_t>(table.integer("seed", 0, std::numeric_limits<int>::max()).value_or(1));
}

bool answers_daylight(Law law) { return law != Law::on && law != Law::off && law != Law::occupancy; }

CircuitPlan read_circuit(const TomlTable& table, const OccupancyPlan& usual) {
  CircuitPlan circuit;
  circuit.place = table.place();
  if (table.require("name")) circuit.name = table.name().value_or("");
  circuit.luminaires = table.texts("luminaires").value_or(std::vector<std::string>{});
  circuit.watts = table.number("watts", kNotNegative);
  if (circuit.luminaires.empty() && !circuit.watts)
    table.problem("name", "it has neither luminaires nor watts",
                  "name its luminaires or groups: luminaires = [\"row A\"]");
  circuit.standby_W = table.number_or("standby", kNotNegative, 0.0);
  circuit.sensors = table.texts("sensors").value_or(std::vector<std::string>{});
  read_settings(table, circuit.settings);
  if (circuit.sensors.empty() && answers_daylight(circuit.settings.law))
    table.problem("law", fmt::format("law '{}' needs sensors", word_of(circuit.settings.law)),
                  "sensors = [\"desk points[0]\"]");
  const auto occupancy = table.table("occupancy", table.label() + ": occupancy");
  circuit.occupancy = occupancy ? read_occupancy(*occupancy, usual) : usual;
  table.refuse_unknown();
  return circuit;
}

BlindPlan read_blind(const TomlTable& table) {
  static const std::vector<std::string> kLaws = {"direct-sun", "irradiance", "illuminance"};
  BlindPlan blind;
  blind.place = table.place();
  if (table.require("windows", "a group of windows")) blind.windows = table.text("windows").value_or("");
  if (table.require("closed", "the state of the windows while closed"))
    blind.closed = table.text("closed").value_or("");
  if (table.require("law", "one of direct-sun, irradiance, illuminance"))
    if (const auto word = table.word("law", kLaws))
      blind.law = static_cast<BlindLaw>(std::find(kLaws.begin(), kLaws.end(), *word) - kLaws.begin());
  if (blind.law == BlindLaw::direct_sun) {
    blind.most_sun_lx = table.number_or("direct_sun", kLux, blind.most_sun_lx);
    blind.most_points = table.number_or("share", kFraction, blind.most_points);
    blind.points = table.texts("points").value_or(std::vector<std::string>{});
  } else {
    table.require("close_above", blind.law == BlindLaw::irradiance ? "W/m2 on the glass" : "lx on the glass");
    blind.close_above = table.number_or("close_above", kPositive, 0.0);
    blind.open_below = table.number_or("open_below", kNotNegative, blind.close_above);
    if (blind.open_below > blind.close_above)
      table.problem("open_below", fmt::format("it opens below {} and closes above {}", blind.open_below,
                                              blind.close_above),
                    "open_below is at most close_above");
  }
  table.refuse_unknown();
  return blind;
}

}  // namespace

ControlPlan read_control(std::string_view text, const std::string& file,
                         const std::vector<std::string>& overrides) {
  const toml::table parsed = parse_toml(text, file, {"control", 1, true, {}}, overrides);
  Problems problems;
  TomlContext context{file, problems};
  const TomlTable root(parsed, "", context);
  root.text("dim");
  ControlPlan plan;
  plan.area_m2 = root.number("area", kPositive);
  const auto occupancy = root.table("occupancy", "occupancy");
  const OccupancyPlan usual = occupancy ? read_occupancy(*occupancy, {}) : OccupancyPlan{};
  std::set<std::string> names;
  for (const auto& table : root.tables("circuit")) {
    plan.circuits.push_back(read_circuit(table, usual));
    if (!names.insert(plan.circuits.back().name).second)
      table.problem("name", fmt::format("a second circuit '{}'", plan.circuits.back().name), "");
  }
  for (const auto& table : root.tables("blind")) plan.blinds.push_back(read_blind(table));
  root.refuse_unknown();
  if (plan.circuits.empty() && plan.blinds.empty() && problems.empty())
    problems.add({file, 1, 1}, "the file has no circuit", "write at least one [[circuit]]");
  problems.throw_if_any();
  return plan;
}

}  // namespace dim
