#include "esp/casual_gain_control.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "esp/esp_text.hpp"

namespace dim {
namespace {

constexpr std::array<int, 8> kLaws = {-1, 0, 1, 2, 3, 4, 31, 32};
constexpr double kLargest = 1e6;
constexpr int kPerLine = 5;

bool has_loop(int law) { return law == 31 || law == 32; }

const char* law_name(int law) {
  switch (law) {
    case -1:
      return "always on";
    case 0:
      return "always off";
    case 1:
      return "on-off";
    case 2:
      return "step";
    case 3:
      return "dimming";
    case 4:
      return "Hunt";
    case 31:
      return "integral reset";
    default:
      return "closed loop";
  }
}

[[noreturn]] void refuse(std::string what) { throw LimitError("casual gain control: " + std::move(what)); }

void check(const CasualGainControl& control) {
  if (control.zones.empty() || control.zones.size() > kMostLightingZones)
    refuse(fmt::format("{} lighting zones, ESP-r takes 1..{}", control.zones.size(), kMostLightingZones));
  if (control.slots.empty() || control.slots.size() > kMostDayTypes ||
      control.slots.size() != control.active_hours.size())
    refuse(fmt::format("{} day types, ESP-r takes 1..{}", control.slots.size(), kMostDayTypes));
  double shares = 0.0;
  for (const auto& zone : control.zones) {
    check_lighting_zone(zone);
    shares += zone.share;
    for (const auto& sensor : zone.sensors)
      if (zone.type == EspSensorType::coefficients && (sensor.set < 1 || sensor.set > kMostCoefficientSets))
        refuse(fmt::format("{} sensors with daylight coefficients, ESP-r takes {}", sensor.set,
                           kMostCoefficientSets));
  }
  if (std::abs(shares - 1.0) > 0.005)
    refuse(fmt::format("shares of the lighting zones add up to {:.3f}, not 1", shares));
}

void write_coefficients(const EspSensor& sensor, std::string& text) {
  text += fmt::format("{:3} {}  # set of coefficients, stages\n", sensor.set, sensor.stages.size());
  for (std::size_t stage = 0; stage < sensor.stages.size(); ++stage) {
    text += fmt::format("{:3}  # stage\n", stage + 1);
    for (std::size_t p = 0; p < kEspPatches; p += kPerLine) {
      for (std::size_t k = p; k < p + kPerLine; ++k)
        text += fmt::format(" {:13.6E}", sensor.stages[stage][k]);
      text += '\n';
    }
  }
}

void write_zone(const EspLightingZone& zone, std::string& text) {
  text +=
      fmt::format("{:6.1f} {:.2f} {:.3f} {:.3f} {}  # setpoint lx, switch off, min light, min power, delay\n",
                  zone.setpoint_lx, zone.switch_off, zone.min_light, zone.min_power, zone.delay_steps);
  text += fmt::format("{:5.2f} {} {}  # share, sensors, type\n", zone.share, zone.sensors.size(),
                      static_cast<int>(zone.type));
  for (const auto& sensor : zone.sensors) {
    if (zone.type == EspSensorType::external) {
      text += fmt::format("{:7.3f} {:7.3f}  # surface, 1 = vertical\n",
                          static_cast<double>(zone.external_surface), 1.0);
      continue;
    }
    text += fmt::format("{:7.3f} {:7.3f} {:7.3f} {:7.3f} {:7.3f} {:7.3f}", sensor.position_m.x,
                        sensor.position_m.y, sensor.position_m.z, sensor.normal.x, sensor.normal.y,
                        sensor.normal.z);
    text += zone.type == EspSensorType::coefficients
                ? fmt::format(" {}  # sensor, direction, set\n", sensor.set)
                : "  # sensor, direction\n";
  }
  if (zone.type == EspSensorType::daylight_factors) {
    text += fmt::format("{:3}  # windows\n", zone.windows.size());
    for (const auto& window : zone.windows)
      for (const double factor : window.factors)
        text += fmt::format("{:3} {:.6f}  # surface, daylight factor over transmittance\n", window.surface,
                            factor);
  }
  text += fmt::format("{:3}  # {}\n", zone.law, law_name(zone.law));
  if (has_loop(zone.law))
    text += fmt::format("{:8.3f} {:.6f}  # night calibration lx, slope\n", zone.night_lx, zone.slope_per_lx);
}

EspLightingZone read_zone(EspReader& in) {
  EspLightingZone zone;
  in.line("a lighting zone");
  zone.setpoint_lx = in.real("setpoint", 0.0, kLargest);
  zone.switch_off = in.real("switch-off factor", 1.0, 3.0);
  zone.min_light = in.real("minimum light", 0.0, 0.999);
  zone.min_power = in.real("minimum power", 0.0, 1.0);
  zone.delay_steps = in.integer("switch-off delay", 0, kMostDelay);
  in.end_line();
  in.line("share, sensors and type");
  zone.share = in.real("share", 0.0, 1.0);
  const int n_sensors = in.integer("number of sensors", 1, kMostSensors);
  zone.type = static_cast<EspSensorType>(in.integer("sensor type", 1, 5));
  in.end_line();
  for (int i = 0; i < n_sensors; ++i) {
    EspSensor sensor;
    in.line("a sensor");
    if (zone.type == EspSensorType::external) {
      zone.external_surface = static_cast<int>(in.real("surface", 0.0, kMostEspSurfaces));
      in.real("orientation", 0.0, 1.0);
    } else {
      for (int axis = 0; axis < 3; ++axis)
        sensor.position_m[axis] = in.real("sensor position", -kLargest, kLargest);
      for (int axis = 0; axis < 3; ++axis) sensor.normal[axis] = in.real("sensor direction", -1.0, 1.0);
      if (zone.type == EspSensorType::coefficients)
        sensor.set = in.integer("coefficient set", 1, kMostCoefficientSets);
    }
    in.end_line();
    zone.sensors.push_back(sensor);
  }
  if (zone.type == EspSensorType::daylight_factors) {
    in.line("the number of windows");
    const int n_windows = in.integer("number of windows", 1, kMostEspSurfaces);
    in.end_line();
    for (int w = 0; w < n_windows; ++w) {
      EspWindow window;
      for (int i = 0; i < n_sensors; ++i) {
        in.line("a daylight factor");
        const int surface = in.integer("window surface", 1, kMostEspSurfaces);
        if (i > 0 && surface != window.surface)
          in.wrong(fmt::format("surface {} among those of {}", surface, window.surface));
        window.surface = surface;
        window.factors.push_back(in.real("daylight factor", 0.0, 10.0));
        in.end_line();
      }
      zone.windows.push_back(window);
    }
  }
  in.line("the control law");
  zone.law = in.integer("control law", -1, 32);
  if (std::find(kLaws.begin(), kLaws.end(), zone.law) == kLaws.end())
    in.wrong(fmt::format("control law {} is none of {}", zone.law, fmt::join(kLaws, ", ")));
  in.end_line();
  if (has_loop(zone.law)) {
    in.line("night calibration and slope");
    zone.night_lx = in.real("night calibration", 0.0, kLargest);
    zone.slope_per_lx = in.real("slope", -kLargest, zone.law == 32 ? -1e-9 : kLargest);
    in.end_line();
  }
  return zone;
}

void read_coefficients(EspReader& in, EspSensor& sensor, std::set<int>& known) {
  in.line("a set of daylight coefficients");
  const int set = in.integer("coefficient set", 1, kMostCoefficientSets);
  const int n_stages = in.integer("number of stages", 1, 2);
  in.end_line();
  if (set != sensor.set) in.wrong(fmt::format("set {} where the sensor says {}", set, sensor.set));
  if (!known.insert(set).second) in.wrong(fmt::format("set {} is there twice", set));
  for (int stage = 1; stage <= n_stages; ++stage) {
    in.line("a stage");
    if (in.integer("stage", 1, 2) != stage) in.wrong(fmt::format("this is stage {}", stage));
    in.end_line();
    std::vector<double> values;
    while (values.size() < kEspPatches) {
      in.line("daylight coefficients");
      for (int k = 0; k < kPerLine; ++k) values.push_back(in.real("daylight coefficient", -1.0, 1.0));
      in.end_line();
    }
    sensor.stages.push_back(values);
  }
}

}  // namespace

void check_lighting_zone(const EspLightingZone& zone) {
  if (zone.sensors.empty() || zone.sensors.size() > kMostSensors)
    refuse(
        fmt::format("{} sensors in a lighting zone, ESP-r takes 1..{}", zone.sensors.size(), kMostSensors));
  if (zone.delay_steps < 0 || zone.delay_steps > kMostDelay)
    refuse(fmt::format("a delay of {} steps, ESP-r takes 0..{}", zone.delay_steps, kMostDelay));
  if (zone.switch_off < 1.0 || zone.switch_off > 3.0)
    refuse(fmt::format("a switch-off factor of {}, ESP-r takes 1..3", zone.switch_off));
  if (zone.type == EspSensorType::daylight_factors && zone.windows.empty())
    refuse("daylight factors without a window");
  for (const auto& window : zone.windows) {
    if (window.surface < 1 || window.surface > kMostEspSurfaces)
      refuse(fmt::format("window surface {}, ESP-r takes 1..{}", window.surface, kMostEspSurfaces));
    if (window.factors.size() != zone.sensors.size())
      refuse("a window needs a daylight factor for every sensor");
  }
}

std::string write_cgc(const CasualGainControl& control) {
  check(control);
  std::string text = "*Casual_gain_ctl\n*desc " + control.description + "\n";
  for (const auto& comment : control.comments) text += "# " + comment + "\n";
  for (const int slot : control.slots) text += fmt::format("{:3}", slot);
  text += "  # gain controlled each day type\n";
  for (const auto& [from, to] : control.active_hours) text += fmt::format("{:3} {:2}", from, to);
  text += "  # active hours each day type\n";
  text += fmt::format("{:3}  # lighting zones\n", control.zones.size());
  for (const auto& zone : control.zones) write_zone(zone, text);
  for (const auto& zone : control.zones)
    if (zone.type == EspSensorType::coefficients)
      for (const auto& sensor : zone.sensors) write_coefficients(sensor, text);
  return text;
}

CasualGainControl read_cgc(std::string_view text, const std::string& file) {
  EspReader in(text, file);
  CasualGainControl control;
  in.tag("*Casual_gain_ctl");
  control.description = in.tag("*desc");
  in.line("the gains controlled each day type");
  const std::size_t n_day_types = in.n_words();
  if (n_day_types > kMostDayTypes)
    in.wrong(fmt::format("{} day types, ESP-r takes 1..{}", n_day_types, kMostDayTypes));
  while (in.n_words() > 0) control.slots.push_back(in.integer("gain slot", 0, 7));
  in.line("the active hours each day type");
  for (std::size_t i = 0; i < n_day_types; ++i) {
    const int from = in.integer("first active hour", 0, 24);
    control.active_hours.emplace_back(from, in.integer("last active hour", from, 24));
  }
  in.end_line();
  in.line("the number of lighting zones");
  const int n_zones = in.integer("number of lighting zones", 1, kMostLightingZones);
  in.end_line();
  double shares = 0.0;
  for (int i = 0; i < n_zones; ++i) {
    control.zones.push_back(read_zone(in));
    shares += control.zones.back().share;
  }
  if (std::abs(shares - 1.0) > 0.005)
    in.wrong(fmt::format("shares of the lighting zones add up to {:.3f}, not 1", shares));
  std::set<int> known;
  for (auto& zone : control.zones)
    if (zone.type == EspSensorType::coefficients)
      for (auto& sensor : zone.sensors) read_coefficients(in, sensor, known);
  in.finish();
  return control;
}

}  // namespace dim
