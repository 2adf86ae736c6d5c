#include "sky/sky_spec.hpp"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "base/error.hpp"
#include "sky/calendar.hpp"
#include "sky/direction.hpp"

namespace dim {
namespace {

constexpr double kBrightest_lx = 1e6;
constexpr double kStrongest_W_m2 = 2000.0;

[[noreturn]] void refuse(std::string_view spec, const std::string& what) {
  throw InputError(Problem{{},
                           fmt::format("sky '{}': {}", spec, what),
                           "say cie-overcast:LUX, cie-N:LUX@ALTITUDE,AZIMUTH, uniform:LUX, "
                           "perez:ALTITUDE,AZIMUTH,IDN,IDH or FILE.epw@MM-DDTHH:MM"});
}

/// One number of a spec.
struct Field {
  std::string_view spec, text;
  const char* what;
  double least, greatest;
};

double number(const Field& field) {
  double value = 0.0;
  const char* end = field.text.data() + field.text.size();
  const auto [stop, error] = std::from_chars(field.text.data(), end, value);
  if (error != std::errc{} || stop != end)
    refuse(field.spec, fmt::format("'{}' is not a number for the {}", field.text, field.what));
  if (!(value >= field.least && value <= field.greatest))
    refuse(field.spec,
           fmt::format("{} {} is outside {}..{}", field.what, field.text, field.least, field.greatest));
  return value;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double sun_altitude(std::string_view spec, std::string_view text) {
  return radians(number({spec, text, "altitude of the sun", 0.0, 90.0}));
}

double sun_azimuth(std::string_view spec, std::string_view text) {
  return radians(number({spec, text, "azimuth of the sun", -360.0, 360.0}));
}

StandardSky standard_sky(std::string_view spec, int cie_type, std::string_view rest) {
  const auto parts = split(rest, '@');
  StandardSky sky{cie_type, number({spec, parts[0], "horizontal illuminance", 0.0, kBrightest_lx})};
  if (parts.size() > 2) refuse(spec, "more than one '@'");
  if (parts.size() == 1) {
    if (cie_type > 0 && SkyModel::cie(cie_type).follows_sun())
      refuse(spec,
             fmt::format("CIE type {} depends on the sun: its altitude and azimuth are missing", cie_type));
    return sky;
  }
  const auto place = split(parts[1], ',');
  if (place.size() != 2) refuse(spec, "after '@' stand the altitude and the azimuth of the sun");
  sky.sun_altitude_rad = sun_altitude(spec, place[0]);
  sky.sun_azimuth_rad = sun_azimuth(spec, place[1]);
  return sky;
}

PerezSky perez_sky(std::string_view spec, std::string_view rest) {
  const auto parts = split(rest, ',');
  if (parts.size() != 4) refuse(spec, fmt::format("perez takes 4 numbers, here are {}", parts.size()));
  return {sun_altitude(spec, parts[0]),
          sun_azimuth(spec, parts[1]),
          {number({spec, parts[2], "direct normal irradiance", 0.0, kStrongest_W_m2}),
           number({spec, parts[3], "diffuse horizontal irradiance", 0.0, kStrongest_W_m2})}};
}

WeatherMoment weather_moment(std::string_view spec) {
  const auto at = spec.rfind('@');
  const auto when = at == std::string_view::npos ? std::string_view{} : spec.substr(at + 1);
  if (when.size() != 11 || when[2] != '-' || when[5] != 'T' || when[8] != ':')
    refuse(spec, "the moment is missing: FILE.epw@MM-DDTHH:MM");
  WeatherMoment moment;
  moment.path = spec.substr(0, at);
  moment.month = static_cast<int>(number({spec, when.substr(0, 2), "month", 1, 12}));
  moment.day = static_cast<int>(number({spec, when.substr(3, 2), "day of the month", 1,
                                        static_cast<double>(days_in_month(2000, moment.month))}));
  const double minutes = number({spec, when.substr(9, 2), "minute", 0, 59});
  moment.hour = number({spec, when.substr(6, 2), "hour", 0, 24}) + minutes / 60.0;
  if (moment.hour > 24.0) refuse(spec, "the day ends at 24:00");
  return moment;
}

}  // namespace

SkySpec parse_sky_spec(std::string_view text) {
  const auto colon = text.find(':');
  const auto name = text.substr(0, colon);
  // A weather file may have any name; its moment has a colon too.
  const bool weather =
      text.find('@') != std::string_view::npos && text.substr(0, text.rfind('@')).ends_with(".epw");
  if (weather || colon == std::string_view::npos) {
    if (!weather && text.find(".epw") == std::string_view::npos) refuse(text, "no such form");
    return weather_moment(text);
  }
  const auto rest = text.substr(colon + 1);
  if (name == "cie-overcast") return standard_sky(text, 0, rest);
  if (name == "uniform") return standard_sky(text, 5, rest);
  if (name == "perez") return perez_sky(text, rest);
  if (!name.starts_with("cie-")) refuse(text, fmt::format("no sky is called '{}'", name));
  const double type = number({text, name.substr(4), "CIE type", 1, 15});
  if (type != static_cast<int>(type)) refuse(text, "CIE types are whole numbers");
  return standard_sky(text, static_cast<int>(type), rest);
}

SkyAndSun sky_and_sun_of(const StandardSky& sky) {
  const Vec3 sun = sky_direction(sky.sun_altitude_rad, sky.sun_azimuth_rad);
  return {sky.cie_type == 0 ? SkyModel::overcast() : SkyModel::cie(sky.cie_type), sun, sky.horizontal_lx,
          0.0};
}

SkyAndSun sky_and_sun_of(const PerezSky& sky) {
  return perez_sky_and_sun(sky_direction(sky.sun_altitude_rad, sky.sun_azimuth_rad), sky.irradiance);
}

}  // namespace dim
