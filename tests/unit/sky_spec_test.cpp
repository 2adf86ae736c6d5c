#include "sky/sky_spec.hpp"

#include "base/error.hpp"
#include "catch.hpp"
#include "reference_csv.hpp"
#include "sky/direction.hpp"

using namespace dim;

TEST_CASE("Skies are read as the command line writes them", "[sky][unit]") {
  const auto clear = std::get<StandardSky>(parse_sky_spec("cie-12:20000@40,150"));
  CHECK(clear.cie_type == 12);
  CHECK(clear.horizontal_lx == 20000.0);
  CHECK(degrees(clear.sun_altitude_rad) == Approx(40.0));
  CHECK(degrees(clear.sun_azimuth_rad) == Approx(150.0));
  CHECK(std::get<StandardSky>(parse_sky_spec("cie-overcast:10000")).cie_type == 0);
  CHECK(std::get<StandardSky>(parse_sky_spec("uniform:1e4")).cie_type == 5);
  const auto perez = std::get<PerezSky>(parse_sky_spec("perez:30,200,600,120"));
  CHECK(perez.irradiance.direct_normal_W_m2 == 600.0);
  CHECK(perez.irradiance.diffuse_horizontal_W_m2 == 120.0);
  const auto moment = std::get<WeatherMoment>(parse_sky_spec("my @ site.epw@12-21T09:30"));
  CHECK(moment.path == "my @ site.epw");
  CHECK(moment.month == 12);
  CHECK(moment.day == 21);
  CHECK(moment.hour == 9.5);
}

TEST_CASE("A wrong sky is refused with what is wrong with it", "[sky][unit]") {
  const std::pair<const char*, const char*> cases[] = {
      {"cie-16:1000", "CIE type 16 is outside 1..15"},
      {"cie-1.5:1000", "whole numbers"},
      {"cie-12:1000", "its altitude and azimuth are missing"},
      {"cie-overcast", "no such form"},
      {"cie-overcast:", "'' is not a number"},
      {"cie-overcast:-5", "outside 0..1000000"},
      {"cie-overcast:nan", "outside 0..1000000"},
      {"cie-12:1000@95,0", "altitude of the sun 95 is outside 0..90"},
      {"cie-12:1000@40", "altitude and the azimuth"},
      {"clear:1000", "no sky is called 'clear'"},
      {"perez:30,200,600", "4 numbers, here are 3"},
      {"perez:-3,200,600,10", "outside 0..90"},
      {"a.epw", "the moment is missing"},
      {"a.epw@13-01T09:30", "month 13 is outside 1..12"},
      {"a.epw@02-30T09:30", "day of the month 30 is outside 1..29"},
      {"a.epw@02-03T24:30", "the day ends"},
  };
  for (const auto& [spec, what] : cases) {
    CAPTURE(spec);
    CHECK_THROWS_WITH(parse_sky_spec(spec), Catch::Contains(what));
  }
}

TEST_CASE("A standard sky gives the illuminance asked for and has no sun", "[sky][unit]") {
  const auto light =
      daylight_of(sky_and_sun_of(std::get<StandardSky>(parse_sky_spec("cie-12:20000@40,150"))));
  CHECK(light.horizontal_lx() == 20000.0);
  CHECK(light.direct_normal_lx == 0.0);
  CHECK(light.sky.luminance_cd_m2(light.sun) > light.sky.luminance_cd_m2({0, 0, 1}));
}

TEST_CASE("Efficacies are those of the published table", "[sky][unit]") {
  const auto table = test::read_reference(test::shared_data() / "sky/perez_1990_luminous_efficacy.csv");
  if (table.rows.empty()) {
    WARN("skipped: no reference data sky/perez_1990_luminous_efficacy.csv");
    return;
  }
  const double altitude = radians(35.0), zenith = radians(55.0), water = 1.4, delta = 0.17;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto k = [&](const char* column) { return table.number(row, column); };
    const SkyClearness state{k("epsilon_low") + 0.01, delta};
    CAPTURE(row);
    if (table.rows[row][0] == "diffuse_horizontal") {
      CHECK(diffuse_efficacy_lm_W(state, altitude, water) ==
            Approx(k("a") + k("b") * water + k("c") * std::cos(zenith) + k("d") * std::log(delta)));
    } else if (table.rows[row][0] == "direct_normal") {
      CHECK(direct_efficacy_lm_W(state, altitude, water) ==
            Approx(k("a") + k("b") * water + k("c") * std::exp(5.73 * zenith - 5.0) + k("d") * delta));
    }
  }
}

TEST_CASE("A Perez day has the light of its irradiances", "[sky][unit]") {
  // 600 W/m2 of beam, 120 of sky with the sun at 30 degrees: epsilon 4.79, Delta 0.173 by hand.
  const auto state = sky_clearness(600.0, 120.0, radians(30.0));
  const double bend = 1.041 * std::pow(kPi / 3.0, 3);
  CHECK(state.clearness == Approx((6.0 + bend) / (1.0 + bend)));
  CHECK(state.brightness == Approx(120.0 * 1.9939 / 1367.0).epsilon(2e-3));
  const auto light = perez_daylight(sky_direction(radians(30.0), 0.0), {600.0, 120.0});
  CHECK(light.sky.horizontal_lx() == Approx(120.0 * diffuse_efficacy_lm_W(state, radians(30.0))));
  CHECK(light.horizontal_lx() == Approx(light.sky.horizontal_lx() + 0.5 * light.direct_normal_lx));
  CHECK(light.direct_normal_lx / 600.0 == Approx(100.0).margin(12.0));
}

TEST_CASE("Without diffuse light the sky is black; below the horizon the sun has no beam", "[sky][unit]") {
  CHECK(perez_daylight(sky_direction(0.5, 0.0), {800.0, 0.0}).sky.horizontal_lx() == 0.0);
  CHECK(perez_daylight(sky_direction(0.5, 0.0), {800.0, 0.0}).direct_normal_lx > 7e4);
  const auto dusk = perez_daylight(sky_direction(-0.05, 0.0), {100.0, 8.0});
  CHECK(dusk.direct_normal_lx == 0.0);
  CHECK(dusk.sky.horizontal_lx() > 0.0);
}
