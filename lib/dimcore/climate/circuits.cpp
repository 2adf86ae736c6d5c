#include "climate/circuits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace dim {
namespace {

/// "desk points[2]" is one point of a set, "desk points" are all.
struct SensorName {
  std::string set;
  std::optional<std::size_t> point;
};

SensorName sensor_name(const std::string& text) {
  const auto open = text.rfind('[');
  if (open == std::string::npos || !text.ends_with(']')) return {text, {}};
  std::size_t point = 0;
  const char* end = text.data() + text.size() - 1;
  const auto [stop, error] = std::from_chars(text.data() + open + 1, end, point);
  if (error != std::errc{} || stop != end) return {text, {}};
  return {text.substr(0, open), point};
}

const PointSet& find_set(const Zone& zone, const std::string& name, const CircuitPlan& circuit) {
  std::vector<std::string> names;
  for (const auto& set : zone.point_sets) {
    if (set.name == name) return set;
    names.push_back(set.name);
  }
  throw InputError(Problem{
      circuit.place, fmt::format("circuit '{}': no sensors or measuring plane '{}'", circuit.name, name),
      name_cure(name, names)});
}

/// Points that a sensor text means.
std::vector<std::pair<std::string, std::size_t>> points_of(const std::string& text, const Zone& zone,
                                                           const CircuitPlan& circuit) {
  const SensorName name = sensor_name(text);
  const PointSet& set = find_set(zone, name.set, circuit);
  if (name.point && *name.point >= set.count)
    throw InputError(Problem{circuit.place,
                             fmt::format("circuit '{}': '{}' has points 0..{}, not {}", circuit.name,
                                         set.name, set.count - 1, *name.point),
                             ""});
  if (quantity_of(zone, set) != Quantity::planar)
    throw InputError(Problem{circuit.place,
                             fmt::format("circuit '{}': '{}' measures {} illuminance, and a sensor is planar",
                                         circuit.name, set.name, quantity_word(quantity_of(zone, set))),
                             ""});
  std::vector<std::pair<std::string, std::size_t>> points;
  for (std::size_t k = name.point.value_or(0); k < (name.point ? *name.point + 1 : set.count); ++k) {
    if (!zone.points[set.first + k].valid)
      throw InputError(Problem{
          circuit.place,
          fmt::format("circuit '{}': sensor '{}[{}]' lies where no light comes", circuit.name, set.name, k),
          "it is outside the zone or inside something"});
    points.emplace_back(fmt::format("{}[{}]", set.name, k), set.first + k);
  }
  return points;
}

double watts_of(const CircuitPlan& plan, const LuminanceDatabase& database) {
  double watts = 0.0;
  for (const auto& name : plan.luminaires) {
    bool found = false;
    std::vector<std::string> names;
    for (const auto& luminaire : database.luminaires()) {
      const Source& source = database.sources()[luminaire.source];
      for (const auto& known : {luminaire.name, source.group, source.name}) names.push_back(known);
      if (luminaire.name != name && source.group != name && source.name != name) continue;
      found = true;
      watts += luminaire.factor * database.photometry()[luminaire.photometry].watts;
    }
    if (!found)
      throw InputError(Problem{plan.place,
                               fmt::format("circuit '{}': no luminaire or group '{}'", plan.name, name),
                               name_cure(name, names)});
  }
  if (plan.watts) return *plan.watts;
  if (watts <= 0.0)
    throw InputError(Problem{
        plan.place, fmt::format("circuit '{}': the fittings of its luminaires state no watts", plan.name),
        "write watts = …"});
  return watts;
}

}  // namespace

ControlSensors sensors_of(const ControlPlan& plan, const Zone& zone) {
  ControlSensors sensors;
  for (const auto& circuit : plan.circuits)
    for (const auto& text : circuit.sensors)
      for (const auto& [name, point] : points_of(text, zone, circuit)) {
        if (std::find(sensors.points.begin(), sensors.points.end(), point) != sensors.points.end()) continue;
        sensors.names.push_back(name);
        sensors.points.push_back(point);
      }
  return sensors;
}

std::vector<Circuit> circuits_of(const ControlPlan& plan, const ControlSensors& sensors,
                                 const LuminanceDatabase& database, const Weather& weather,
                                 const std::function<std::string(const std::string& name)>& load) {
  std::vector<Circuit> circuits;
  for (const auto& from : plan.circuits) {
    Circuit circuit;
    circuit.name = from.name;
    circuit.watts = watts_of(from, database);
    circuit.standby_W = from.standby_W;
    circuit.settings = from.settings;
    for (const auto& text : from.sensors)
      for (const auto& [name, point] : points_of(text, database.zone(), from))
        circuit.sensors.push_back(static_cast<std::size_t>(
            std::find(sensors.points.begin(), sensors.points.end(), point) - sensors.points.begin()));
    const OccupancyPlan& occupancy = from.occupancy;
    circuit.present =
        occupancy.presence_file.empty()
            ? occupied_steps(weather, occupancy.schedule)
            : parse_presence(load(occupancy.presence_file), occupancy.presence_file, weather.steps.size());
    circuit.present = held_on(circuit.present, occupancy.hold_on_h, weather.step_h);
    circuits.push_back(std::move(circuit));
  }
  return circuits;
}

double floor_area_m2(const Zone& zone) {
  constexpr double kLevel = 0.99;
  double area_m2 = 0.0;
  for (const auto& surface : zone.surfaces)
    if (surface.bounding && surface.polygon.frame().n.z > kLevel) area_m2 += surface.polygon.area_m2();
  return area_m2;
}

}  // namespace dim
