#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "climate/blinds.hpp"
#include "climate/lighting_year.hpp"
#include "sky/calendar.hpp"

namespace dim {

/// The outside at a step of a zone lighting level file.
struct LevelStep {
  LocalTime end;                                         ///< local standard time
  double sun_altitude_deg = 0.0, sun_azimuth_deg = 0.0;  ///< apparent; azimuth from north through east
  double direct_normal_W_m2 = 0.0, diffuse_horizontal_W_m2 = 0.0;
};

/// A zone lighting level file: what reaches the control sensors and what the lamps do, step by step.
struct ZoneLightingLevels {
  std::vector<std::pair<std::string, std::string>> about;  ///< header lines `# key: value`
  std::vector<LevelStep> steps;
  std::vector<SensorYear> sensors;
  std::vector<std::string> circuit_names;
  std::vector<CircuitYear> circuits;
  std::vector<BlindYear> blinds;
};

/// CSV: header lines `# key: value`, a row of column names, a row a step. Columns: year, month, day, hour
/// (end of the step), sun_altitude_deg, sun_azimuth_deg, direct_normal_W_m2, diffuse_horizontal_W_m2; of
/// every sensor NAME:sun_lx, NAME:sky_lx, NAME:total_lx; of every circuit NAME:light, NAME:power (shares of
/// full), NAME:watts; watts of all; of every operated group of windows GROUP:closed, 0 or 1.
std::string write_levels(const ZoneLightingLevels& levels);

}  // namespace dim
