#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "base/vec.hpp"
#include "sky/daylight.hpp"

namespace dim {

/// `cie-overcast:LUX`, `cie-N:LUX@ALT,AZI`, `uniform:LUX`: a sky of a form and its horizontal illuminance,
/// lx.
struct StandardSky {
  int cie_type = 0;  ///< 1..15; 0 for the traditional overcast sky
  double horizontal_lx = 0.0;
  double sun_altitude_rad = 0.5 * kPi;
  double sun_azimuth_rad = 0.0;
};

/// `perez:ALT,AZI,IDN,IDH`: irradiances in W/m2.
struct PerezSky {
  double sun_altitude_rad = 0.0;
  double sun_azimuth_rad = 0.0;
  Irradiance irradiance;
};

/// `FILE.epw@MM-DDTHH:MM`: a moment of a weather file, its local standard time.
struct WeatherMoment {
  std::string path;
  int month = 1, day = 1;
  double hour = 0.0;  ///< 0..24
};

using SkySpec = std::variant<StandardSky, PerezSky, WeatherMoment>;

/// Reads what a command line calls a sky. Altitudes and azimuths are in degrees, azimuths from north through
/// east; types 2, 4 and 6 to 15 need the sun's place.
/// @throws InputError  without a place: what is wrong, and the forms there are
SkySpec parse_sky_spec(std::string_view text);

/// The sky itself.
SkyAndSun sky_and_sun_of(const StandardSky& sky);
SkyAndSun sky_and_sun_of(const PerezSky& sky);

}  // namespace dim
