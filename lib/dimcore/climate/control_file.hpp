#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "climate/blinds.hpp"
#include "climate/control_law.hpp"
#include "climate/occupancy.hpp"

namespace dim {

/// When somebody is there: hours and days, or a CSV of presence.
struct OccupancyPlan {
  Schedule schedule;
  std::string presence_file;  ///< as written, relative to the control file; empty: the schedule
  double hold_on_h = 0.0;     ///< how long after leaving the room still counts as used
  Place place;
};

/// A group of luminaires that one law controls, as the file names it.
struct CircuitPlan {
  std::string name;
  std::vector<std::string> luminaires;  ///< names, sources or groups of the luminance database
  std::optional<double> watts;  ///< of all its lamps at full light; else those of its luminaires' fittings
  double standby_W = 0.0;       ///< of its control gear, day and night
  std::vector<std::string> sensors;  ///< "desk points" or "desk points[2]"
  ControlSettings settings;
  OccupancyPlan occupancy;
  Place place;
};

/// CONTROL.toml: docs/daylight.md.
struct ControlPlan {
  std::optional<double> area_m2;  ///< that LENI is stated for; else that of the floors
  std::vector<CircuitPlan> circuits;
  std::vector<BlindPlan> blinds;
};

/// @param overrides  `--set KEY=VALUE`, see parse_toml
/// @throws InputError  every problem together, with file, line and column
ControlPlan read_control(std::string_view text, const std::string& file,
                         const std::vector<std::string>& overrides = {});

}  // namespace dim
