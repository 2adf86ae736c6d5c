#include "climate/sensor_year.hpp"

#include "base/error.hpp"
#include "catch.hpp"
#include "climate/paper_method.hpp"
#include "sky/weather_light.hpp"

using namespace dim;

namespace {

Weather two_days() {
  Weather weather;
  weather.latitude_deg = 52.0;
  weather.first_weekday = 6;
  for (const int day : {172, 173}) {
    for (int hour = 1; hour <= 24; ++hour) {
      WeatherStep step;
      step.end = date_of(2001, day);
      step.end.hour = hour;
      step.irradiance = {500.0, 120.0};
      step.global_horizontal_W_m2 = 400.0;
      weather.steps.push_back(step);
    }
  }
  return weather;
}

/// Coefficients that are 1000 row + point, so that a place can be told.
DaylightCoefficients numbered() {
  DaylightCoefficients c;
  c.n_points = 5;
  for (int row = 0; row < 145 + 1 + 7; ++row)
    for (int p = 0; p < 5; ++p) {
      c.total_lx.push_back(static_cast<float>(1000 * row + p));
      c.direct_lx.push_back(static_cast<float>(-1000 * row - p));
    }
  return c;
}

}  // namespace

TEST_CASE("Chosen points keep their coefficients and their sun", "[climate][unit]") {
  const auto some = at_points(numbered(), {4, 1});
  CHECK(some.n_points == 2);
  CHECK(some.total_lx[2 * 7] == 7004.0F);
  CHECK(some.total_lx[2 * 7 + 1] == 7001.0F);
  CHECK(some.direct_lx[2 * 145 + 1] == -145001.0F);
  const auto sun = at_points(
      [](const Vec3&, std::size_t first, std::span<float> factors) {
        for (std::size_t i = 0; i < factors.size(); ++i) factors[i] = static_cast<float>(first + i);
      },
      {4, 1});
  std::vector<float> factors(2);
  sun({0, 0, 1}, 0, factors);
  CHECK(factors == std::vector<float>{4.0F, 1.0F});
}

TEST_CASE("Steps cut in four keep their irradiance and have suns of their own", "[climate][unit]") {
  const auto fine = subdivided(two_days(), 4);
  REQUIRE(fine.steps.size() == 4 * 48);
  CHECK(fine.step_h == 0.25);
  CHECK(fine.steps[0].end.hour == 0.25);
  CHECK(fine.steps[4 * 48 - 1].end.hour == 24.0);
  CHECK(fine.steps[49].irradiance.diffuse_horizontal_W_m2 == 120.0);
  CHECK(sun_of(fine, fine.steps[48]).azimuth_rad < sun_of(fine, fine.steps[49]).azimuth_rad);
}

TEST_CASE("Days are chosen with their weekday", "[climate][unit]") {
  const auto second = between(two_days(), 6, 22, 6, 22);
  REQUIRE(second.steps.size() == 24);
  CHECK(second.first_weekday == 0);
  CHECK(between(two_days(), 12, 1, 2, 1).steps.empty());
  CHECK(between(two_days(), 12, 1, 6, 21).steps.size() == 24);
}

TEST_CASE("The paper's year is its equation at every step, sun and sky apart", "[climate][unit]") {
  const auto weather = two_days();
  const auto years = paper_sensor_years({"a", "b"}, weather, {0.02, 0.1},
                                        [](const Vec3&, std::size_t first, std::span<float> factors) {
                                          for (std::size_t i = 0; i < factors.size(); ++i)
                                            factors[i] = 0.3F * static_cast<float>(first + i);
                                        });
  REQUIRE(years.size() == 2);
  const double altitude = degrees(sun_of(weather, weather.steps[12]).apparent_altitude_rad);
  CHECK(years[0].sun_lx[12] == 0.0F);
  CHECK(years[1].sun_lx[12] == Approx(0.3 * 500.0 * beam_efficacy_lm_W(altitude)).epsilon(1e-4));
  const double cover = 0.09;
  CHECK(years[1].sky_lx[12] ==
        Approx(0.1 * 120.0 * ((1.0 - cover) * 144.0 + cover * overcast_efficacy_lm_W(altitude, 400.0))));
  CHECK(years[0].sky_lx[12] == Approx(0.2 * static_cast<double>(years[1].sky_lx[12])));
  // At night no beam, whatever the file says.
  CHECK(years[1].sun_lx[0] == 0.0F);
}
