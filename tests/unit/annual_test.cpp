#include "climate/annual.hpp"

#include <numeric>

#include "catch.hpp"
#include "climate/blinds.hpp"
#include "climate/metrics.hpp"
#include "sky/direction.hpp"
#include "sky/weather_light.hpp"

using namespace dim;

namespace {

/// Coefficients of open sensors with these normals, by midpoints in every patch, ramps with them; the ground where it
/// shows. A share of the light counts as reflected.
DaylightCoefficients open_sensors(int subdivision, const std::vector<Vec3>& normals, double reflected = 0.0) {
  const SkyPatches patches(subdivision);
  DaylightCoefficients c;
  c.subdivision = subdivision;
  c.n_points = normals.size();
  c.direct_lx.assign(patches.n_columns() * c.n_points, 0.0F);
  for (std::size_t p = 0; p <= patches.ground(); ++p) {
    const std::size_t band = p == patches.ground() ? patches.n_ramps() : patches.band_of(p);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      constexpr int kSide = 40;
      double even = 0.0, ramp = 0.0;
      for (int k = 0; k < kSide * kSide; ++k) {
        const Vec3 d = patches.direction(p, (k / kSide + 0.5) / kSide, (k % kSide + 0.5) / kSide);
        const double sr = std::max(0.0, glm::dot(d, normals[i])) * patches.solid_angle_sr(p) / (kSide * kSide);
        even += sr;
        if (band < patches.n_ramps()) ramp += sr * patches.ramp_cd_m2(band, d.z);
      }
      c.direct_lx[p * c.n_points + i] += static_cast<float>(even);
      if (band < patches.n_ramps()) c.direct_lx[patches.ramp(band) * c.n_points + i] += static_cast<float>(ramp);
    }
  }
  for (const float lx : c.direct_lx) c.total_lx.push_back(static_cast<float>(static_cast<double>(lx) * (1.0 + reflected)));
  return c;
}

/// Three days of changing sky in Denver's place.
Weather some_days() {
  Weather weather;
  weather.latitude_deg = 39.76;
  weather.longitude_deg = -104.86;
  weather.time_zone_h = -7.0;
  for (const int day : {20, 100, 172}) {
    for (int hour = 1; hour <= 24; ++hour) {
      WeatherStep step;
      step.end = date_of(2001, day);
      step.end.hour = hour;
      if (sun_of(weather, step).apparent_altitude_rad > 0.0) {
        step.irradiance.direct_normal_W_m2 = day == 100 ? 0.0 : 700.0 - 20.0 * hour;
        step.irradiance.diffuse_horizontal_W_m2 = 60.0 + day;
      }
      weather.steps.push_back(step);
    }
  }
  return weather;
}

SunFactors open_sun(const std::vector<Vec3>& normals) {
  return [normals](const Vec3& towards, std::size_t first, std::span<float> factors) {
    for (std::size_t i = 0; i < factors.size(); ++i)
      factors[i] = static_cast<float>(std::max(0.0, glm::dot(towards, normals[first + i])));
  };
}

}  // namespace

TEST_CASE("An open level sensor has the horizontal illuminance of every hour", "[climate][annual][unit]") {
  const int subdivision = GENERATE(1, 2);
  const std::vector<Vec3> up = {{0, 0, 1}};
  const auto weather = some_days();
  const auto sky = annual_sky(weather, subdivision, 0.2);
  CHECK(sky.lit.size() > 30);
  annual_illuminance(sky, open_sensors(subdivision, up), open_sun(up), [&](const PointBlock& block) {
    for (std::size_t i = 0; i < sky.n_steps; ++i) {
      const auto light = sky_and_sun_of(weather, weather.steps[i]);
      const double sun_lx = light.direct_normal_lx * std::max(0.0, light.sun.z);
      CHECK(block.sky(0)[i] == Approx(light.sky_horizontal_lx).epsilon(1e-3));
      CHECK(block.sun(0)[i] == Approx(sun_lx).epsilon(1e-5));
      CHECK(block.direct_sun(0)[i] == Approx(sun_lx).epsilon(1e-5));
    }
  });
}

TEST_CASE("A level sensor that looks down sees the ground alone", "[climate][annual][unit]") {
  const std::vector<Vec3> down = {{0, 0, -1}};
  const auto weather = some_days();
  const auto sky = annual_sky(weather, 1, 0.3);
  annual_illuminance(sky, open_sensors(1, down), open_sun(down), [&](const PointBlock& block) {
    const auto light = sky_and_sun_of(weather, weather.steps[12]);
    const double horizontal = light.sky_horizontal_lx + light.direct_normal_lx * light.sun.z;
    CHECK(block.sky(0)[12] == Approx(0.3 * horizontal).epsilon(1e-3));
  });
}

TEST_CASE("Reflected sun comes by the patches around it, once", "[climate][annual][unit]") {
  const int subdivision = GENERATE(1, 2, 4);
  // All light counts half as much again reflected: open sensors then have half the sun's beam, blurred.
  const std::vector<Vec3> up = {{0, 0, 1}};
  const auto weather = some_days();
  const auto sky = annual_sky(weather, subdivision, 0.0);
  annual_illuminance(sky, open_sensors(subdivision, up, 0.5), open_sun(up), [&](const PointBlock& block) {
    const auto light = sky_and_sun_of(weather, weather.steps[12]);
    const double sun_lx = light.direct_normal_lx * light.sun.z;
    CHECK(block.direct_sun(0)[12] == Approx(sun_lx).epsilon(1e-5));
    // Reflected light is off by the sine's curvature over a band alone, at most a sixth of the square of its height.
    const double height = sky.patches.box(0).high_rad;
    CHECK(block.sun(0)[12] == Approx(1.5 * sun_lx).epsilon(height * height / 6.0));
  });
}

TEST_CASE("Shares of a sun add up to one and point at it", "[climate][annual][unit]") {
  const SkyPatches patches(GENERATE(1, 2, 4));
  const double lowest = 0.5 * patches.box(0).high_rad;
  for (const double altitude : {0.1, 1.0, 7.0, 33.3, 80.0, 88.0, 90.0}) {
    for (const double azimuth : {0.0, 10.0, 93.0, 271.7}) {
      const Vec3 sun = sky_direction(radians(altitude), radians(azimuth));
      const auto shares = sun_shares(patches, sun);
      double sum = 0.0;
      Vec3 middle(0.0);
      for (const auto& s : shares) {
        CHECK(s.share >= 0.0);
        sum += s.share;
        middle += s.share * patches.centre(s.patch);
      }
      CAPTURE(altitude, azimuth);
      CHECK(sum == Approx(1.0));
      // Below the lowest middles the sun is taken up to them; patches round the cap are wide.
      const double low = radians(altitude) < lowest ? lowest : 0.0;
      CHECK(glm::length(glm::normalize(middle) - sun) < (patches.subdivision() == 1 ? 0.05 : 0.012) + low);
    }
  }
}

TEST_CASE("Blocks of points and lanes are filled to the last point", "[climate][annual][unit]") {
  const auto weather = some_days();
  const auto sky = annual_sky(weather, 1, 0.2);
  std::vector<Vec3> normals;
  for (int i = 0; i < 300; ++i) normals.push_back(sky_direction(radians(90.0 - 0.3 * i), 1.0));
  std::vector<float> at_noon;
  annual_illuminance(sky, open_sensors(1, normals), open_sun(normals), [&](const PointBlock& block) {
    CHECK(block.first == at_noon.size());
    for (std::size_t p = 0; p < block.n_points; ++p) at_noon.push_back(block.sky(p)[60]);
  });
  REQUIRE(at_noon.size() == 300);
  for (const std::size_t p : {std::size_t{17}, std::size_t{255}, std::size_t{299}}) {
    annual_illuminance(sky, open_sensors(1, {normals[p]}), open_sun({normals[p]}),
                       [&](const PointBlock& block) { CHECK(block.sky(0)[60] == at_noon[p]); });
  }
}

TEST_CASE("Spread over its patch, the sun lights an open sensor by the patch's mean cosine",
          "[climate][annual][unit]") {
  const auto coefficients = open_sensors(1, {{0, 0, 1}});
  const auto factors = spread_sun(coefficients);
  const SkyPatches patches;
  const Vec3 sun = sky_direction(radians(40.0), 2.0);
  float factor = 0.0F;
  factors(sun, 0, {&factor, 1});
  const auto p = patches.patch_of(sun);
  CHECK(factor == Approx(patches.horizontal_sr(p) / patches.solid_angle_sr(p)).epsilon(1e-3));
  factors({0, 0.8, -0.6}, 0, {&factor, 1});
  CHECK(factor == 0.0F);
}

TEST_CASE("Metrics of a year are counted by hand", "[climate][metrics][unit]") {
  MetricTimes times;
  times.occupied = {true, true, true, true, true, false};
  times.daylight = {0, 1, 2, 3, 4, 5};
  times.step_h = 0.5;
  const std::vector<float> lx = {0, 150, 299, 300, 3001, 6000}, sun = {0, 0, 0, 0, 1001, 5000};
  const auto m = point_metrics(lx, sun, times, 300.0);
  CHECK(m.autonomy == Approx(2.0 / 5.0));
  CHECK(m.continuous_autonomy == Approx((0.0 + 0.5 + 299.0 / 300.0 + 1.0 + 1.0) / 5.0));
  CHECK(m.useful_low == Approx(0.2));
  CHECK(m.useful_supplementary == Approx(0.4));
  CHECK(m.useful_autonomous == Approx(0.2));
  CHECK(m.useful_high == Approx(0.2));
  CHECK(m.exposure_lx_h == Approx(0.5 * (150 + 299 + 300 + 3001 + 6000)));
  CHECK(m.half_daylight_lx == 300.0);
  CHECK(m.direct_sun_h == 0.5);
}

TEST_CASE("A place that nobody uses has no autonomy", "[climate][metrics][unit]") {
  MetricTimes times;
  times.occupied = {false};
  times.daylight = {0};
  const float lx = 500.0F;
  CHECK(point_metrics({&lx, 1}, {&lx, 1}, times, 300.0).autonomy == 0.0);
}

TEST_CASE("A plane is judged by half and by 95 per cent of its points", "[climate][metrics][unit]") {
  std::vector<PointMetrics> points(20);
  for (std::size_t i = 0; i < 20; ++i) {
    points[i].half_daylight_lx = 50.0 + 50.0 * static_cast<double>(i);  // 50 .. 1000
    points[i].autonomy = i < 8 ? 0.5 : 0.49;
    points[i].direct_sun_h = i < 3 ? 251.0 : 250.0;
  }
  const auto plane = plane_metrics(points);
  CHECK(plane.target_lx == 550.0);   // ten of twenty reach it
  CHECK(plane.minimum_lx == 100.0);  // nineteen of twenty
  CHECK(plane.provision == Provision::minimum);
  CHECK(plane.spatial_autonomy == Approx(0.4));
  CHECK(plane.sun_exposure == Approx(0.15));
  CHECK(plane.mean.half_daylight_lx == Approx(525.0));
  CHECK(provision_of(299.0, 100.0) == Provision::none);
  CHECK(provision_of(800.0, 300.0) == Provision::medium);
  CHECK(provision_of(750.0, 500.0) == Provision::high);
}

TEST_CASE("Windows that change give each step the light of the state that they are in", "[climate][annual][unit]") {
  const std::vector<Vec3> up = {{0, 0, 1}};
  const auto sky = annual_sky(some_days(), 1, 0.2);
  WindowPart open{open_sensors(1, up), open_sun(up), {}, true};
  WindowPart closed{open_sensors(1, up, 1.0), [](const Vec3&, std::size_t, std::span<float> f) {
                      std::fill(f.begin(), f.end(), 0.0F);
                    }, {}, false};
  for (std::size_t i = 0; i < sky.lit.size(); ++i) {
    open.active.push_back(i % 3 != 0);
    closed.active.push_back(i % 3 == 0);
  }
  PointBlock always_open, always_closed;
  annual_illuminance(sky, open.coefficients, open.sun, [&](const PointBlock& block) { always_open = block; });
  annual_illuminance(sky, closed.coefficients, closed.sun, [&](const PointBlock& block) { always_closed = block; });
  annual_illuminance(sky, std::vector<WindowPart>{open, closed}, [&](const PointBlock& block) {
    for (std::size_t i = 0; i < sky.lit.size(); ++i) {
      const PointBlock& expected = i % 3 == 0 ? always_closed : always_open;
      CHECK(block.sky(0)[sky.lit[i]] == expected.sky(0)[sky.lit[i]]);
      CHECK(block.sun(0)[sky.lit[i]] == expected.sun(0)[sky.lit[i]]);
      CHECK(block.direct_sun(0)[sky.lit[i]] == always_open.direct_sun(0)[sky.lit[i]]);
    }
  });
}

TEST_CASE("Blinds close above one level and open below another", "[climate][unit]") {
  CHECK(closed_by_level({0, 100, 160, 120, 100, 120}, 150, 110) ==
        std::vector<bool>{false, false, true, true, false, false});
  // One level: closed while above it.
  CHECK(closed_by_level({0.02, 0.03, 0.02}, 0.02, 0.02) == std::vector<bool>{false, true, false});
}

TEST_CASE("Daylight hours are the brightest half of the year", "[climate][metrics][unit]") {
  AnnualSky sky(1);
  sky.n_steps = 8760;
  for (std::size_t i = 0; i < 8760; ++i) sky.sky_horizontal_lx.push_back(i % 2 ? 1000.0 : 10.0);
  const auto steps = daylight_steps(sky);
  REQUIRE(steps.size() == 4380);
  for (const std::size_t i : steps) REQUIRE(i % 2 == 1);
}
