#include "sky/sun_position.hpp"

#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "sky/calendar.hpp"
#include "sky/direction.hpp"

using namespace dim;

TEST_CASE("The sun stands where ERFA puts it, 1950 to 2050 at all latitudes", "[sky][unit]") {
  std::ifstream file(DIM_SOURCE_DIR "/tests/data/sky/sun_erfa.csv");
  int n = 0;
  double worst_deg = 0.0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'j') continue;
    std::istringstream fields(line);
    double value[5];
    char comma;
    for (double& v : value) fields >> v >> comma;
    const auto sun = sun_position(value[0], radians(value[1]), radians(value[2]));
    const Vec3 seen = sky_direction(sun.altitude_rad, sun.azimuth_rad);
    const Vec3 expected = sky_direction(radians(value[3]), radians(value[4]));
    worst_deg = std::max(worst_deg, degrees(2.0 * std::asin(0.5 * glm::length(seen - expected))));
    ++n;
  }
  CHECK(n == 400);
  CHECK(worst_deg < 0.002);
}

TEST_CASE("The worked example of the Solar Position Algorithm comes out", "[sky][unit]") {
  // Reda & Andreas 2004, table A5.1: 17 October 2003, 12:30:30 at UTC-7, Golden, Colorado.
  const double day = julian_day({2003, 10, 17, 12.0 + 30.5 / 60.0}, -7.0);
  CHECK(day == Approx(2452930.312847).margin(1e-6));
  const auto sun = sun_position(day, radians(39.742476), radians(-105.1786));
  // Theirs is for 820 hPa and 11 degrees C, where air lifts the sun by 0.0163 degrees.
  CHECK(90.0 - degrees(sun.altitude_rad) == Approx(50.11162 + 0.0163).margin(0.002));
  CHECK(degrees(sun.azimuth_rad) == Approx(194.34024).margin(0.002));
  CHECK(sun.distance_au == Approx(0.9965423).margin(2e-5));
}

TEST_CASE("Air lifts the sun by 0.57 degrees at the horizon and not at all far below it", "[sky][unit]") {
  CHECK(degrees(refraction_rad(radians(-0.5))) == Approx(0.57).margin(0.03));
  CHECK(degrees(refraction_rad(radians(45.0))) == Approx(1.0 / 60.0).margin(0.001));
  CHECK(refraction_rad(radians(-2.0)) == 0.0);
}

TEST_CASE("Days are counted through leap years and over time zones", "[sky][unit]") {
  CHECK(julian_day({2000, 1, 1, 12.0}, 0.0) == 2451545.0);
  CHECK(julian_day({1987, 6, 19, 12.0}, 0.0) == 2446966.0);
  CHECK(julian_day({2024, 3, 1, 0.0}, 0.0) - julian_day({2024, 2, 28, 0.0}, 0.0) == 2.0);
  CHECK(julian_day({2023, 6, 1, 1.0}, 1.0) == julian_day({2023, 6, 1, 0.0}, 0.0));
  CHECK(day_of_year(1900, 12, 31) == 365);
  CHECK(date_of(2024, 60).day == 29);
}

TEST_CASE("Moments are read to the minute, and no others", "[sky][unit]") {
  const auto time = parse_local_time("2024-02-29T09:30");
  REQUIRE(time);
  CHECK(time->day == 29);
  CHECK(time->hour == 9.5);
  CHECK(parse_local_time("1950-01-01T24:00")->hour == 24.0);
  for (const char* text : {"2023-02-29T09:30", "2024-13-01T09:30", "2024-01-01T24:01", "2024-01-01T09:60",
                           "1949-12-31T09:30", "2051-01-01T09:30", "2024-01-01 09:30", "2024-01-01T9:30", "",
                           "2024-01--1T09:30", "2024-01-01T-9:30", "2024-01-01T09:30:00"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_local_time(text));
  }
}
