#include "climate/occupancy.hpp"

#include <numeric>

#include "base/error.hpp"
#include "catch.hpp"

using namespace dim;

namespace {

/// Weather without light: a year of steps from Monday, 1 January.
Weather calendar(double step_h = 1.0) {
  Weather weather;
  weather.step_h = step_h;
  for (int day = 1; day <= 365; ++day)
    for (double hour = step_h; hour < 24.0 + 0.5 * step_h; hour += step_h) {
      WeatherStep step;
      step.end = date_of(2001, day);
      step.end.hour = hour;
      weather.steps.push_back(step);
    }
  return weather;
}

long count(const std::vector<bool>& flags) { return std::count(flags.begin(), flags.end(), true); }

}  // namespace

TEST_CASE("Occupied hours are those whose middle is", "[climate][occupancy][unit]") {
  const auto occupied = occupied_steps(calendar(), parse_hours("08:00-18:00"));
  CHECK(count(occupied) == 3650);
  CHECK_FALSE(occupied[7]);
  CHECK(occupied[8]);
  CHECK(occupied[17]);
  CHECK_FALSE(occupied[18]);
  CHECK(count(occupied_steps(calendar(0.25), parse_hours("08:30-09:00"))) == 730);
}

TEST_CASE("Weekends stay empty where a schedule says so", "[climate][occupancy][unit]") {
  auto schedule = parse_hours("00:00-24:00");
  schedule.days[5] = schedule.days[6] = false;
  // 2001 here begins on a Monday: 52 weeks and a Monday.
  CHECK(count(occupied_steps(calendar(), schedule)) == 24 * (52 * 5 + 1));
}

TEST_CASE("Summer time moves people an hour ahead of the sun", "[climate][occupancy][unit]") {
  auto schedule = parse_hours("08:00-18:00");
  schedule.summer_time = parse_summer_time("03-29,10-25");
  const auto occupied = occupied_steps(calendar(), schedule);
  CHECK(count(occupied) == 3650);
  CHECK_FALSE(occupied[7]);
  const std::size_t june = 24 * 170;
  CHECK(occupied[june + 7]);
  CHECK_FALSE(occupied[june + 17]);
  schedule.summer_time = parse_summer_time("10-04,04-05");
  CHECK(occupied_steps(calendar(), schedule)[7]);
  CHECK_FALSE(occupied_steps(calendar(), schedule)[june + 7]);
}

TEST_CASE("Hours and dates that are none are refused", "[climate][occupancy][unit]") {
  for (const char* text : {"", "8-18", "18:00-08:00", "08:00-25:00", "08:61-09:00", "08:00"})
    CHECK_THROWS_AS(parse_hours(text), InputError);
  for (const char* text : {"", "03-29", "13-01,10-25", "02-30,10-25"})
    CHECK_THROWS_AS(parse_summer_time(text), InputError);
}

TEST_CASE("Presence is read a step a row", "[climate][occupancy][unit]") {
  CHECK(parse_presence("hour,people\r\n1,0\r\n2,3\r\n3,0.5\r\n", "p.csv", 3) ==
        std::vector<bool>{false, true, true});
  CHECK_THROWS_WITH(parse_presence("0\n1\n", "p.csv", 3), Catch::Contains("2 rows of presence for 3 steps"));
  CHECK_THROWS_WITH(parse_presence("0\nx\n", "p.csv", 2), Catch::Contains("p.csv:2: presence 'x'"));
  CHECK_THROWS_WITH(parse_presence("0\n-1\n", "p.csv", 2), Catch::Contains("p.csv:2: presence '-1'"));
}

TEST_CASE("Who has left within the hold-on time still counts as there", "[climate][occupancy][unit]") {
  const std::vector<bool> present = {false, true, false, false, false, true};
  CHECK(held_on(present, 0.5, 0.25) == std::vector<bool>{false, true, true, true, false, true});
  CHECK(held_on(present, 0.0, 0.25) == present);
}
