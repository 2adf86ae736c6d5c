#include "esp/level_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace dim {
namespace {

/// In quotes where a comma or a quote is in it (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string write_levels(const ZoneLightingLevels& levels) {
  std::string text;
  for (const auto& [key, value] : levels.about) text += fmt::format("# {}: {}\n", key, value);
  text += "year,month,day,hour,sun_altitude_deg,sun_azimuth_deg,direct_normal_W_m2,diffuse_horizontal_W_m2";
  for (const auto& sensor : levels.sensors)
    for (const char* part : {":sun_lx", ":sky_lx", ":total_lx"}) text += ',' + field(sensor.name + part);
  for (const auto& name : levels.circuit_names)
    for (const char* part : {":light", ":power", ":watts"}) text += ',' + field(name + part);
  text += ",watts";
  for (const auto& blind : levels.blinds) text += ',' + field(blind.windows + ":closed");
  text += '\n';
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < levels.steps.size(); ++i) {
    const LevelStep& step = levels.steps[i];
    fmt::format_to(out, "{},{},{},{:.6g},{:.4f},{:.4f},{:.6g},{:.6g}", step.end.year, step.end.month,
                   step.end.day, step.end.hour, step.sun_altitude_deg, step.sun_azimuth_deg,
                   step.direct_normal_W_m2, step.diffuse_horizontal_W_m2);
    for (const auto& sensor : levels.sensors)
      fmt::format_to(out, ",{:.7g},{:.7g},{:.7g}", sensor.sun_lx[i], sensor.sky_lx[i], sensor.total_lx(i));
    double watts = 0.0;
    for (const auto& circuit : levels.circuits) {
      fmt::format_to(out, ",{:.6g},{:.6g},{:.7g}", circuit.lamps[i].light, circuit.lamps[i].power,
                     circuit.watts[i]);
      watts += circuit.watts[i];
    }
    fmt::format_to(out, ",{:.7g}", watts);
    for (const auto& blind : levels.blinds) text += blind.closed[i] ? ",1" : ",0";
    text += '\n';
  }
  return text;
}

}  // namespace dim
