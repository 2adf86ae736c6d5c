#include <fmt/format.h>

#include "base/error.hpp"
#include "catch.hpp"
#include "shared_data.hpp"
#include "sky/direction.hpp"
#include "sky/weather_light.hpp"

using namespace dim;

namespace {

struct FileForm {
  double latitude = 52.0;
  int per_hour = 1;
  bool leap = false;
  std::string end = "\n";
};

/// A year of 300 W/m2 direct, 100 diffuse at every hour, day and night.
std::string year(const FileForm& form) {
  std::string text = fmt::format("LOCATION,Place,County,LAND,made,1,{},0.0,0.0,10", form.latitude) + form.end;
  for (const char* line : {"DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0",
                           "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,a, b", "COMMENTS 2,"})
    text += line + form.end;
  text += fmt::format("DATA PERIODS,1,{},Data,Sunday,1/ 1,12/31", form.per_hour) + form.end;
  const int y = form.leap ? 2004 : 2003;
  for (int day = 1; day <= (form.leap ? 366 : 365); ++day) {
    const auto date = date_of(y, day);
    for (int hour = 1; hour <= 24; ++hour) {
      for (int k = 1; k <= form.per_hour; ++k)
        text +=
            fmt::format(
                "{},{},{},{},{},flags,10,{},80,101325,0,0,300,250,300,100,999900,999900,999900,9999,0,0,0,0,"
                "9,77777,9,999999999,0,0,0,88,0,0,0",
                y, date.month, date.day, hour, k * 60 / form.per_hour, "5.0") +
            form.end;
    }
  }
  return text;
}

/// Replaces `what` at its n-th place.
std::string changed(std::string text, const std::string& what, const std::string& by, int n = 1) {
  std::size_t at = text.find(what);
  while (--n > 0) at = text.find(what, at + 1);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("A weather file gives its place and a step an hour", "[sky][epw][unit]") {
  const auto weather = parse_epw(year({}), "a.epw");
  CHECK(weather.place == "Place, LAND");
  CHECK(weather.latitude_deg == 52.0);
  REQUIRE(weather.steps.size() == 8760);
  CHECK(weather.steps.front().end.hour == 1.0);
  CHECK(weather.steps.back().end.month == 12);
  CHECK(weather.steps.back().end.hour == 24.0);
  CHECK(weather.steps[5].irradiance.direct_normal_W_m2 == 300.0);
  CHECK(weather.steps[5].water_cm == Approx(std::exp(0.07 * 5.0 - 0.075)));
  CHECK(weather.warnings.empty());
}

TEST_CASE("CR LF, a byte order mark and blank fields change nothing", "[sky][epw][unit]") {
  const auto weather =
      parse_epw("\xEF\xBB\xBF" + changed(year({.end = "\r\n"}), ",80,101325,0,0,300,", ",,,,,,"), "a.epw");
  CHECK(weather.steps.size() == 8760);
  CHECK(weather.steps.back().irradiance.diffuse_horizontal_W_m2 == 100.0);
}

TEST_CASE("Leap years and quarters of an hour are counted", "[sky][epw][unit]") {
  CHECK(parse_epw(year({.leap = true}), "a.epw").steps.size() == 8784);
  const auto weather = parse_epw(year({.per_hour = 4}), "a.epw");
  REQUIRE(weather.steps.size() == 4 * 8760);
  CHECK(weather.step_h == 0.25);
  CHECK(weather.steps[0].end.hour == 0.25);
  CHECK(weather.steps[5].end.hour == 1.5);
}

TEST_CASE("A missing irradiance follows from the two others", "[sky][epw][unit]") {
  // Row of 1 January 12:00.
  const auto weather = parse_epw(year({}), "a.epw");
  const double sine = std::sin(sun_of(weather, weather.steps[11]).apparent_altitude_rad);
  const auto row = [&](const std::string& by) {
    return parse_epw(changed(year({}), ",250,300,100,", by, 12), "a.epw").steps[11];
  };
  CHECK(row(",250,300,9999,").irradiance.diffuse_horizontal_W_m2 == Approx(250.0 - 300.0 * sine));
  CHECK(row(",250,,100,").irradiance.direct_normal_W_m2 == Approx(150.0 / sine));
  CHECK(row(",9999,300,100,").global_horizontal_W_m2 == Approx(100.0 + 300.0 * sine));
}

TEST_CASE("A day without irradiance is dark and said so; a missing dew point is usual", "[sky][epw][unit]") {
  auto weather = parse_epw(changed(year({}), ",250,300,100,", ",9999,,9999,", 12), "a.epw");
  CHECK(weather.steps[11].irradiance.direct_normal_W_m2 == 0.0);
  REQUIRE(weather.warnings.size() == 1);
  CHECK(weather.warnings[0].what == "1 rows by day have no irradiance");
  weather = parse_epw(changed(year({}), ",10,5.0,", ",10,99.9,"), "a.epw");
  CHECK(weather.steps[0].water_cm == 2.0);
}

TEST_CASE("What is wrong in a weather file is said with its line", "[sky][epw][unit]") {
  const std::string good = year({});
  const auto refused = [](const std::string& text, const std::string& what) {
    CAPTURE(what);
    CHECK_THROWS_WITH(parse_epw(text, "a.epw"), Catch::Contains(what));
  };
  refused("", "before its LOCATION");
  refused("x,y\n", "a.epw:1: not an EPW weather file");
  refused(changed(good, ",52,", ",95,"), "a.epw:1: latitude 95 is outside -90..90");
  refused(changed(good, ",300,100,", ",-1,100,"), "a.epw:9: direct normal radiation -1 is outside");
  refused(changed(good, ",300,100,", ",abc,100,"), "'abc' is not a number");
  refused(changed(good, "2003,1,1,2,60", "2003,13,1,2,60"), "a.epw:10: month 13 is outside 1..12");
  refused(changed(good, "2003,1,1,2,60", "2003,1,32,2,60"), "day 32 is outside");
  // Rows after a wrong one are read on: all problems together.
  refused(changed(changed(good, "2003,1,1,2,60", "2003,13,1,2,60"), ",300,100,", ",-1,100,"), "month 13 is outside");
  refused(changed(changed(good, "2003,1,1,1,60", "2003,13,1,1,60"), ",300,100,", ",-1,100,"),
          "direct normal radiation -1 is outside");
  refused(changed(good, "2003,1,1,2,60", "2003,1,1,25,60"), "hour 25 is outside 1..24");
  refused(changed(good, "2003,1,1,2,60", "2003,1,1,3,60"),
          "a.epw:10: the row of 1/1 hour 3 follows that of 1/1 hour 1");
  refused(changed(good, ",88,0,0,0\n", "\n"), "a.epw:9: 31 fields, 32 to 35 are right");
  refused(good.substr(0, good.find("2003,6,1,13,")), "promises 12/31 hour 24");
  refused(changed(good, "DATA PERIODS,1,1", "DATA PERIODS,1,7"), "records per hour 7: must divide 60");
  refused(good.substr(0, good.find("2003,")), "no rows follow");
}

TEST_CASE("The sun of an hour stands at its middle, at dawn in the middle of what it is up",
          "[sky][epw][unit]") {
  const auto weather = parse_epw(year({}), "a.epw");
  const auto& noon = weather.steps[24 * 79 + 12];
  LocalTime middle = noon.end;
  middle.hour -= 0.5;
  CHECK(sun_of(weather, noon).azimuth_rad == sun_at(weather, middle).azimuth_rad);
  // Near the equinox the sun rises at about 6:04: the hour to 7 is nearly all day, in the hour to 6 it is
  // night.
  const auto& dawn = weather.steps[24 * 79 + 6];
  double up = 0.0;
  for (int second = 0; second < 3600; second += 5) {
    LocalTime time = dawn.end;
    time.hour = 6.0 + second / 3600.0;
    if (sun_at(weather, time).apparent_altitude_rad > 0.0) up += 5.0 / 3600.0;
  }
  REQUIRE(up < 0.99);
  LocalTime time = dawn.end;
  time.hour = 7.0 - 0.5 * up;
  CHECK(sun_of(weather, dawn).azimuth_rad == Approx(sun_at(weather, time).azimuth_rad).margin(3e-4));
}

TEST_CASE("South of the equator the noon sun is in the north", "[sky][epw][unit]") {
  const auto weather = parse_epw(year({.latitude = -35.0}), "a.epw");
  const auto sun = sun_of(weather, weather.steps[24 * 171 + 12]).direction();
  CHECK(sun.y > 0.8);
  CHECK(degrees(altitude_rad(sun)) == Approx(90.0 - 35.0 - 23.44).margin(0.7));
}

TEST_CASE("A moment has the irradiance of its hour and its own sun", "[sky][epw][unit]") {
  const auto weather = parse_epw(changed(year({}), ",250,300,100,", ",250,300,140,", 24 * 354 + 10), "a.epw");
  const auto moment = std::get<WeatherMoment>(parse_sky_spec("a.epw@12-21T09:45"));
  const auto light = sky_and_sun_of(weather, moment);
  CHECK(light.sky_horizontal_lx >
        1.3 * sky_and_sun_of(weather, weather.steps[24 * 354 + 10]).sky_horizontal_lx);
  CHECK(light.sun.y == Approx(sun_at(weather, {2003, 12, 21, 9.75}).direction().y));
  CHECK_THROWS_AS(sky_and_sun_of(weather, std::get<WeatherMoment>(parse_sky_spec("a.epw@02-29T09:45"))),
                  InputError);
}

TEST_CASE("Real weather closes: global is direct on the level plus diffuse", "[sky][epw][unit]") {
  std::ifstream file;
  const auto [name, global_kWh_m2, rms_W_m2] =
      GENERATE(std::tuple{"weather/USA_CO_Denver-Stapleton_TMY.epw", 1831.9, 37.0},
               std::tuple{"weather/GBR_SCT_Glasgow.AP.031400_TMYx.epw", 918.5, 14.5});
  if (!test::open_shared(file, name)) return;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto weather = parse_epw(text, name);
  double global = 0.0, gap2 = 0.0;
  int n_day = 0;
  for (const auto& step : weather.steps) {
    global += step.global_horizontal_W_m2 / 1000.0;
    if (step.global_horizontal_W_m2 <= 0.0) continue;
    const double sine = std::sin(sun_of(weather, step).apparent_altitude_rad);
    const double gap = step.global_horizontal_W_m2 - step.irradiance.diffuse_horizontal_W_m2 -
                       step.irradiance.direct_normal_W_m2 * std::max(0.0, sine);
    gap2 += gap * gap;
    ++n_day;
  }
  CHECK(global == Approx(global_kWh_m2).margin(0.1));
  // The sun half an hour off would make it 60 and more.
  CHECK(std::sqrt(gap2 / n_day) < rms_W_m2);
}
