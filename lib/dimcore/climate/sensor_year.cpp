#include "climate/sensor_year.hpp"

#include "climate/paper_method.hpp"
#include "sky/weather_light.hpp"

namespace dim {

DaylightCoefficients at_points(const DaylightCoefficients& coefficients,
                               const std::vector<std::size_t>& points) {
  DaylightCoefficients some = coefficients;
  some.n_points = points.size();
  some.total_lx.clear();
  some.direct_lx.clear();
  for (std::size_t row = 0; row < SkyPatches(coefficients.subdivision).n_columns(); ++row) {
    for (const std::size_t p : points) {
      some.total_lx.push_back(coefficients.total_lx[row * coefficients.n_points + p]);
      some.direct_lx.push_back(coefficients.direct_lx[row * coefficients.n_points + p]);
    }
  }
  return some;
}

SunFactors at_points(const SunFactors& sun, const std::vector<std::size_t>& points) {
  return [sun, points](const Vec3& towards, std::size_t first, std::span<float> factors) {
    for (std::size_t i = 0; i < factors.size(); ++i) sun(towards, points[first + i], factors.subspan(i, 1));
  };
}

std::vector<WindowPart> at_points(const std::vector<WindowPart>& parts, const std::vector<std::size_t>& points) {
  std::vector<WindowPart> some;
  for (const auto& part : parts)
    some.push_back({at_points(part.coefficients, points), at_points(part.sun, points), part.active,
                    part.counts_as_direct});
  return some;
}

std::vector<SensorYear> sensor_years(const std::vector<std::string>& names, const AnnualSky& sky,
                                     const std::vector<WindowPart>& parts, const Job& job) {
  std::vector<SensorYear> years;
  annual_illuminance(
      sky, parts,
      [&](const PointBlock& block) {
        for (std::size_t p = 0; p < block.n_points; ++p) {
          const auto of_sky = block.sky(p), of_sun = block.sun(p);
          years.push_back(
              {names[years.size()], {of_sky.begin(), of_sky.end()}, {of_sun.begin(), of_sun.end()}});
        }
      },
      job);
  return years;
}

std::vector<SensorYear> paper_sensor_years(const std::vector<std::string>& names, const Weather& weather,
                                           const std::vector<double>& factors, const SunFactors& sun) {
  std::vector<SensorYear> years;
  for (const auto& name : names) years.push_back({name, {}, {}});
  std::vector<float> sun_factors(names.size());
  for (const auto& step : weather.steps) {
    const SunPosition position = sun_of(weather, step);
    PaperIrradiance light{degrees(position.apparent_altitude_rad), step.irradiance.direct_normal_W_m2,
                          step.irradiance.diffuse_horizontal_W_m2, step.global_horizontal_W_m2};
    const bool shines = light.sun_altitude_deg > 0.0 && light.direct_normal_W_m2 > 0.0;
    if (shines) sun(position.direction(), 0, sun_factors);
    for (std::size_t s = 0; s < names.size(); ++s) {
      const double both =
          paper_illuminance_lx(light, factors[s], shines ? static_cast<double>(sun_factors[s]) : 0.0);
      const double sky = paper_illuminance_lx(light, factors[s], 0.0);
      years[s].sky_lx.push_back(static_cast<float>(sky));
      years[s].sun_lx.push_back(static_cast<float>(both - sky));
    }
  }
  return years;
}

Weather subdivided(const Weather& weather, int n) {
  Weather fine = weather;
  fine.step_h = weather.step_h / n;
  fine.steps.clear();
  for (const auto& step : weather.steps) {
    for (int k = 1; k <= n; ++k) {
      fine.steps.push_back(step);
      fine.steps.back().end.hour = step.end.hour - weather.step_h + k * fine.step_h;
    }
  }
  return fine;
}

Weather between(const Weather& weather, int first_month, int first_day, int last_month, int last_day) {
  const auto order = [](int month, int day) { return 32 * month + day; };
  const int first = order(first_month, first_day), last = order(last_month, last_day);
  Weather some = weather;
  some.steps.clear();
  int weekday = weather.first_weekday;
  for (std::size_t i = 0; i < weather.steps.size(); ++i) {
    const LocalTime& end = weather.steps[i].end;
    if (i > 0 && end.day != weather.steps[i - 1].end.day) weekday = (weekday + 1) % 7;
    const int day = order(end.month, end.day);
    if (!(first <= last ? day >= first && day <= last : day >= first || day <= last)) continue;
    if (some.steps.empty()) some.first_weekday = weekday;
    some.steps.push_back(weather.steps[i]);
  }
  return some;
}

}  // namespace dim
