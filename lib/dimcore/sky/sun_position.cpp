#include "sky/sun_position.hpp"

#include <span>

#include "sky/direction.hpp"

namespace dim {
namespace {

/// A cos(B + C t), t in Julian millennia from J2000, A in 1e-8 rad or 1e-8 astronomical units.
struct Term {
  double a, b, c;
};

// Reda & Andreas 2004, table A4.2 (from VSOP87): heliocentric longitude and radius of the earth.
constexpr Term kL0[] = {{175347046, 0, 0},           {3341656, 4.6692568, 6283.07585},
                        {34894, 4.6261, 12566.1517}, {3497, 2.7441, 5753.3849},
                        {3418, 2.8289, 3.5231},      {3136, 3.6277, 77713.7715},
                        {2676, 4.4181, 7860.4194},   {2343, 6.1352, 3930.2097},
                        {1324, 0.7425, 11506.7698},  {1273, 2.0371, 529.691},
                        {1199, 1.1096, 1577.3435},   {990, 5.233, 5884.927},
                        {902, 2.045, 26.298},        {857, 3.508, 398.149},
                        {780, 1.179, 5223.694},      {753, 2.533, 5507.553},
                        {505, 4.583, 18849.228}};
constexpr Term kL1[] = {
    {628331966747, 0, 0}, {206059, 2.678235, 6283.07585}, {4303, 2.6351, 12566.1517}, {425, 1.59, 3.523}};
constexpr Term kL2[] = {{52919, 0, 0}, {8720, 1.0721, 6283.0758}};
constexpr Term kR0[] = {{100013989, 0, 0},
                        {1670700, 3.0984635, 6283.07585},
                        {13956, 3.05525, 12566.1517},
                        {3084, 5.1985, 77713.7715}};
constexpr Term kR1[] = {{103019, 1.10749, 6283.07585}};

double sum(std::span<const Term> terms, double t) {
  double total = 0.0;
  for (const auto& term : terms) total += term.a * std::cos(term.b + term.c * t);
  return 1e-8 * total;
}

/// Terrestrial time less universal time, days (Espenak & Meeus 2006, within some seconds over 1950..2050; the
/// sun moves by 0.04 arc seconds in one).
double terrestrial_less_universal(double centuries) {
  const double years = 100.0 * centuries;  // from 2000
  const double seconds = years < 0.0 ? 63.8 + 0.55 * years - 0.0025 * years * years
                                     : 62.92 + 0.32217 * years + 0.005589 * years * years;
  return seconds / 86400.0;
}

struct Nutation {
  double longitude_rad, obliquity_rad;
};

/// The four largest terms (Reda & Andreas 2004, table A4.3); the rest add up to less than 0.0002 degrees.
Nutation nutation(double centuries) {
  const double node = radians(125.04452 - 1934.136261 * centuries);
  const double sun2 = radians(2.0 * (280.4665 + 36000.7698 * centuries));
  const double moon2 = radians(2.0 * (218.3165 + 481267.8813 * centuries));
  const double arc_seconds = radians(1.0 / 3600.0);
  return {arc_seconds * (-17.20 * std::sin(node) - 1.32 * std::sin(sun2) - 0.23 * std::sin(moon2) +
                         0.21 * std::sin(2.0 * node)),
          arc_seconds * (9.20 * std::cos(node) + 0.57 * std::cos(sun2) + 0.10 * std::cos(moon2) -
                         0.09 * std::cos(2.0 * node))};
}

/// Greenwich mean sidereal time (Reda & Andreas 2004, eq. 28).
double sidereal_time_rad(double julian_day_ut, double centuries) {
  const double turns_deg =
      280.46061837 + 360.98564736629 * (julian_day_ut - 2451545.0) + 0.000387933 * centuries * centuries;
  return radians(std::remainder(turns_deg, 360.0));
}

/// Of the sun as seen from the middle of the earth: x to the equinox of date, z north.
struct Geocentric {
  Vec3 direction;
  double distance_au;
  double equinox_rad;  ///< shift of apparent against mean sidereal time
};

Geocentric geocentric_sun(double julian_day_ut) {
  const double ut_centuries = (julian_day_ut - 2451545.0) / 36525.0;
  const double centuries = ut_centuries + terrestrial_less_universal(ut_centuries) / 36525.0;
  const double t = 0.1 * centuries;
  const double distance_au = sum(kR0, t) + t * sum(kR1, t);
  const Nutation shift = nutation(centuries);
  // Seen from the earth, opposite to the earth seen from the sun; aberration of 20.4898" at one unit.
  const double longitude = sum(kL0, t) + t * (sum(kL1, t) + t * sum(kL2, t)) + kPi + shift.longitude_rad -
                           radians(20.4898 / 3600.0) / distance_au;
  const double obliquity =
      radians(23.4392911 - 0.0130042 * centuries - 1.64e-7 * centuries * centuries) + shift.obliquity_rad;
  return {Vec3(std::cos(longitude), std::sin(longitude) * std::cos(obliquity),
               std::sin(longitude) * std::sin(obliquity)),
          distance_au, shift.longitude_rad * std::cos(obliquity)};
}

}  // namespace

Vec3 SunPosition::direction() const { return sky_direction(apparent_altitude_rad, azimuth_rad); }

double refraction_rad(double true_altitude_rad) {
  const double altitude_deg = degrees(true_altitude_rad);
  if (altitude_deg < -(0.26667 + 0.5667)) return 0.0;

  return radians(1.02 / (60.0 * std::tan(radians(altitude_deg + 10.3 / (altitude_deg + 5.11)))));
}

SunPosition sun_position(double julian_day_ut, double latitude_rad, double longitude_rad) {
  const double centuries = (julian_day_ut - 2451545.0) / 36525.0;
  const Geocentric sun = geocentric_sun(julian_day_ut);
  const double turn = sidereal_time_rad(julian_day_ut, centuries) + sun.equinox_rad + longitude_rad;
  // Equatorial x, y turned to the meridian: `meridian` in it, `east` across it.
  const double meridian = std::cos(turn) * sun.direction.x + std::sin(turn) * sun.direction.y;
  const double east = -std::sin(turn) * sun.direction.x + std::cos(turn) * sun.direction.y;
  const double sine = std::sin(latitude_rad), cosine = std::cos(latitude_rad);
  const Vec3 seen(east, cosine * sun.direction.z - sine * meridian,
                  sine * sun.direction.z + cosine * meridian);

  SunPosition position;
  position.distance_au = sun.distance_au;
  position.azimuth_rad = azimuth_rad(seen);
  const double from_centre = altitude_rad(seen);
  // Parallax of 8.794" at one unit, from the surface of a round earth.
  position.altitude_rad = from_centre - radians(8.794 / 3600.0) / sun.distance_au * std::cos(from_centre);
  position.apparent_altitude_rad = position.altitude_rad + refraction_rad(position.altitude_rad);
  return position;
}

}  // namespace dim
