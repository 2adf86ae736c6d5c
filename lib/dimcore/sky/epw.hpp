#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/job.hpp"
#include "sky/calendar.hpp"
#include "sky/daylight.hpp"

namespace dim {

/// Averages over the time before a moment.
struct WeatherStep {
  LocalTime end;  ///< of the step, local standard time; hour in (0, 24]
  Irradiance irradiance;
  double global_horizontal_W_m2 = 0.0;
  double water_cm = kUsualWater_cm;  ///< precipitable, from the dew point; the usual where that is missing
};

/// What daylight needs of a weather file.
struct Weather {
  std::string place;
  double latitude_deg = 0.0;   ///< north positive
  double longitude_deg = 0.0;  ///< east positive
  double time_zone_h = 0.0;    ///< east positive
  double step_h = 1.0;
  int first_weekday = 0;           ///< of the first row's day, 0 Monday .. 6 Sunday
  std::vector<WeatherStep> steps;  ///< in order, without gaps
  Warnings warnings;
};

/// Reads an EnergyPlus weather file (.epw): its place, and time, irradiances and dew point of every row. CR
/// LF, a byte order mark and blank fields are taken; blanks and the missing-value codes count as missing.
/// Where one of global, direct and diffuse irradiance is missing by day it follows from the other two; where
/// two are, the row is dark and a warning counts such rows.
///
/// @param file  name for messages
/// @throws InputError  not such a file, cut short, rows out of order, too few fields, impossible values: all
///                     problems with file and line
Weather parse_epw(std::string_view text, const std::string& file);

/// The same from a path, or `-`.
/// @throws IoError  cannot be read
Weather read_epw(const std::string& path, const Job& job = {});

}  // namespace dim
