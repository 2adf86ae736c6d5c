#include "sky/weather_light.hpp"

#include <fmt/format.h>

namespace dim {
namespace {

/// Hour between two of which one has the sun up, to a second.
double sunrise_or_set(const Weather& weather, LocalTime time, double down_hour, double up_hour) {
  while (std::abs(up_hour - down_hour) > 1.0 / 3600.0) {
    time.hour = 0.5 * (down_hour + up_hour);
    (sun_at(weather, time).apparent_altitude_rad > 0.0 ? up_hour : down_hour) = time.hour;
  }
  return up_hour;
}

SkyAndSun light_of(const SunPosition& sun, const WeatherStep& step) {
  return perez_sky_and_sun(sun.direction(), step.irradiance, sun.distance_au, step.water_cm);
}

}  // namespace

SunPosition sun_at(const Weather& weather, const LocalTime& time) {
  return sun_position(julian_day(time, weather.time_zone_h), radians(weather.latitude_deg),
                      radians(weather.longitude_deg));
}

SunPosition sun_of(const Weather& weather, const WeatherStep& step) {
  LocalTime time = step.end;
  const double end = time.hour, begin = end - weather.step_h, middle = 0.5 * (begin + end);
  const auto up = [&](double hour) {
    time.hour = hour;
    return sun_at(weather, time).apparent_altitude_rad > 0.0;
  };
  const bool first = up(begin), half = up(middle), last = up(end);
  double from = begin, to = end;
  if (first || half || last) {
    if (!first)
      from = half ? sunrise_or_set(weather, time, begin, middle) : sunrise_or_set(weather, time, middle, end);
    if (!last)
      to = half ? sunrise_or_set(weather, time, end, middle) : sunrise_or_set(weather, time, middle, begin);
  }
  time.hour = 0.5 * (from + to);
  return sun_at(weather, time);
}

SkyAndSun sky_and_sun_of(const Weather& weather, const WeatherStep& step) {
  return light_of(sun_of(weather, step), step);
}

Warnings beam_without_sun(const Weather& weather, const std::string& file) {
  std::size_t n = 0;
  for (const auto& step : weather.steps)
    n += step.irradiance.direct_normal_W_m2 > 0.0 && !(sun_of(weather, step).apparent_altitude_rad > 0.0);
  if (n == 0) return {};
  return {{{file},
           fmt::format("{} of {} steps have direct radiation with the sun below the horizon: it is left out", n,
                       weather.steps.size()),
           "are place, time zone and hours of its LOCATION line right?"}};
}

SkyAndSun sky_and_sun_of(const Weather& weather, const WeatherMoment& moment) {
  for (const auto& step : weather.steps) {
    if (step.end.month != moment.month || step.end.day != moment.day) continue;
    // The first moment of a day belongs to its first step.
    const bool holds =
        moment.hour <= step.end.hour + 1e-9 && moment.hour > step.end.hour - weather.step_h + 1e-9;
    if (!holds && !(moment.hour == 0.0 && step.end.hour <= weather.step_h)) continue;
    LocalTime time = step.end;
    time.hour = moment.hour;
    return light_of(sun_at(weather, time), step);
  }
  throw InputError(Problem{
      {moment.path},
      fmt::format("holds no weather of {:02}-{:02} at {:05.2f} h", moment.month, moment.day, moment.hour),
      "the rows of a weather file may cover a part of the year, and 29 February in leap years only"});
}

}  // namespace dim
