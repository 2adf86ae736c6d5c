#pragma once

#include "base/vec.hpp"

namespace dim {

/// Angular diameter of the sun at its mean distance, radians (0.533 degrees).
inline constexpr double kSunDiameter_rad = 0.533 * kPi / 180.0;
/// Solid angle of that disc.
inline constexpr double kSunSolidAngle_sr = 6.7965e-5;

/// Where the sun stands, seen from a place at sea level.
struct SunPosition {
  double altitude_rad = 0.0;           ///< true altitude of its centre, without refraction
  double apparent_altitude_rad = 0.0;  ///< lifted by refraction, which is what light enters a window by
  double azimuth_rad = 0.0;            ///< from north through east, 0 .. 2 pi
  double distance_au = 1.0;

  /// Towards the apparent sun, x east, y north, z up.
  Vec3 direction() const;
};

/// Position of the sun after Reda & Andreas 2004 ("Solar position algorithm for solar radiation
/// applications"), with the terms of the earth's orbit above 5e-6 rad, the four largest of nutation, and
/// universal time taken for UT1.
///
/// @param julian_day_ut  see `julian_day`; years 1950..2050
/// @param latitude_rad   north positive, -pi/2 .. pi/2
/// @param longitude_rad  east positive
/// @error  0.0016 degrees of arc against ERFA 2.0 over 1950..2050 at all latitudes
/// (tests/unit/sun_position_test)
SunPosition sun_position(double julian_day_ut, double latitude_rad, double longitude_rad);

/// How much air of 1010 hPa and 10 degrees C lifts the sun (Reda & Andreas 2004, eq. 42); 0 where the whole
/// disc is below the horizon.
double refraction_rad(double true_altitude_rad);

}  // namespace dim
