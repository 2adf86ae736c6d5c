#include "sky/epw.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/input_file.hpp"
#include "sky/weather_light.hpp"

namespace dim {
namespace {

constexpr std::size_t kMaxEpwBytes = std::size_t{256} << 20;
constexpr std::size_t kFewestFields = 32;
constexpr std::size_t kMostFields = 35;
constexpr double kMissing_W_m2 = 9999.0;
constexpr double kMissingDewPoint_C = 99.9;
/// Below this the beam is not derived from horizontal irradiances: their difference is all rounding.
constexpr double kLowSun_rad = 5.0 * kPi / 180.0;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The fields of a line at commas.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// 0 Monday .. 6 Sunday; Monday for another word.
int weekday(std::string_view word) {
  constexpr std::array<std::string_view, 7> kDays = {"Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"};
  for (std::size_t i = 0; i < kDays.size(); ++i)
    if (word.substr(0, 3) == kDays[i]) return static_cast<int>(i);
  return 0;
}

/// Reads the text line by line; what is wrong is collected.
class EpwParser {
 public:
  EpwParser(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  Weather parse() {
    header();
    problems_.throw_if_any();
    while (next_line()) {
      if (!trimmed(line_text_).empty()) row(fields_of(line_text_));
    }
    check_end();
    problems_.throw_if_any();
    if (n_dark_ > 0)
      weather_.warnings.push_back(
          {{file_}, fmt::format("{} rows by day have no irradiance", n_dark_), "they count as dark"});
    return std::move(weather_);
  }

 private:
  void header();
  void location(const std::vector<std::string_view>& fields);
  void data_periods(const std::vector<std::string_view>& fields);
  void row(const std::vector<std::string_view>& fields);
  void set_time(const std::vector<std::string_view>& fields, WeatherStep& step);
  void set_irradiance(const std::vector<std::string_view>& fields, WeatherStep& step);
  void check_order(const WeatherStep& step);
  void check_end();

  bool next_line() {
    if (rest_.empty()) return false;
    const auto end = rest_.find('\n');
    line_text_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return true;
  }
  void wrong(const std::string& what, const std::string& cure = "") {
    problems_.add({file_, line_}, what, cure);
  }

  /// A number that must be there and within limits; `least` where it is not.
  double needed(std::string_view text, const std::string& what, double least, double greatest) {
    const auto value = number(text);
    if (!value)
      wrong(fmt::format("{} '{}' is not a number", what, text));
    else if (*value < least || *value > greatest)
      wrong(fmt::format("{} {} is outside {}..{}", what, text, least, greatest));
    else
      return *value;
    return least;
  }

  /// A value that may be missing: blank, or at or above its code.
  double optional(std::string_view text, const std::string& what, double least, double greatest,
                  double missing) {
    if (text.empty()) return std::nan("");
    const auto value = number(text);
    if (value && *value >= missing) return std::nan("");
    return needed(text, what, least, greatest);
  }

  std::string_view rest_, line_text_;
  std::string file_;
  int line_ = 0;
  int n_per_hour_ = 1, n_in_hour_ = 0;
  std::size_t n_dark_ = 0;
  std::optional<std::array<int, 2>> last_day_;
  Problems problems_;
  Weather weather_;
};

void EpwParser::header() {
  constexpr std::array<std::string_view, 8> kNames = {"LOCATION",
                                                      "DESIGN CONDITIONS",
                                                      "TYPICAL/EXTREME PERIODS",
                                                      "GROUND TEMPERATURES",
                                                      "HOLIDAYS/DAYLIGHT SAVING",
                                                      "COMMENTS 1",
                                                      "COMMENTS 2",
                                                      "DATA PERIODS"};
  for (const auto name : kNames) {
    if (!next_line()) return wrong(fmt::format("the file ends before its {} line", name), "is it complete?");
    const auto fields = fields_of(line_text_);
    if (!fields[0].starts_with(name))
      throw InputError(
          Problem{{file_, line_},
                  fmt::format("not an EPW weather file: its line {} should begin with {}", line_, name),
                  "an .epw file begins with eight header lines"});
    if (name == "LOCATION") location(fields);
    if (name == "DATA PERIODS") data_periods(fields);
  }
}

void EpwParser::location(const std::vector<std::string_view>& fields) {
  if (fields.size() < 10) return wrong(fmt::format("LOCATION has {} fields, 10 are needed", fields.size()));
  weather_.place = fmt::format("{}, {}", fields[1], fields[3]);
  weather_.latitude_deg = needed(fields[6], "latitude", -90.0, 90.0);
  weather_.longitude_deg = needed(fields[7], "longitude", -180.0, 180.0);
  weather_.time_zone_h = needed(fields[8], "time zone", -12.0, 14.0);
}

void EpwParser::data_periods(const std::vector<std::string_view>& fields) {
  if (fields.size() < 7) return wrong(fmt::format("DATA PERIODS has {} fields, 7 are needed", fields.size()));
  const double n_periods = needed(fields[1], "number of data periods", 1.0, 100.0);
  const double per_hour = needed(fields[2], "records per hour", 1.0, 60.0);
  n_per_hour_ = static_cast<int>(per_hour);
  if (n_per_hour_ != per_hour || 60 % n_per_hour_ != 0)
    wrong(fmt::format("records per hour {}: must divide 60", fields[2]));
  weather_.step_h = 1.0 / n_per_hour_;
  weather_.first_weekday = weekday(fields[4]);
  // The end of the last period, "12/31", maybe with a year.
  const auto end = fields[4 * static_cast<std::size_t>(n_periods) + 2 < fields.size()
                              ? 4 * static_cast<std::size_t>(n_periods) + 2
                              : fields.size() - 1];
  const auto slash = end.find('/');
  if (slash == std::string_view::npos) return;
  const auto month = number(trimmed(end.substr(0, slash))), day = number(trimmed(end.substr(slash + 1, 2)));
  if (month && day) last_day_ = {static_cast<int>(*month), static_cast<int>(*day)};
}

void EpwParser::row(const std::vector<std::string_view>& fields) {
  if (fields.size() < kFewestFields || fields.size() > kMostFields)
    return wrong(fmt::format("{} fields, {} to {} are right", fields.size(), kFewestFields, kMostFields),
                 rest_.empty() ? "is the file complete?" : "");
  WeatherStep step;
  set_time(fields, step);
  const double dew_point_C = optional(fields[7], "dew point", -90.0, 70.0, kMissingDewPoint_C);
  if (!std::isnan(dew_point_C)) step.water_cm = precipitable_water_cm(dew_point_C);
  set_irradiance(fields, step);
  weather_.steps.push_back(step);
}

void EpwParser::set_time(const std::vector<std::string_view>& fields, WeatherStep& step) {
  const double year = needed(fields[0], "year", 1.0, 9999.0), month = needed(fields[1], "month", 1.0, 12.0);
  step.end.year = static_cast<int>(year);
  step.end.month = static_cast<int>(month);
  // 29 February may stand in a year that had none, where months of several years make up one.
  const double longest = step.end.month == 2 ? 29 : days_in_month(2000, step.end.month);
  step.end.day = static_cast<int>(needed(fields[2], "day", 1.0, longest));
  const int hour = static_cast<int>(needed(fields[3], "hour", 1.0, 24.0));
  needed(fields[4], "minute", 0.0, 60.0);
  while (step.end.day == 29 && step.end.month == 2 && !is_leap_year(step.end.year)) ++step.end.year;
  // Minutes are written in several ways; the place in the hour says the same.
  n_in_hour_ = n_in_hour_ % n_per_hour_ + 1;
  step.end.hour = hour - 1 + n_in_hour_ * weather_.step_h;
  if (problems_.empty()) check_order(step);
}

void EpwParser::check_order(const WeatherStep& step) {
  if (weather_.steps.empty()) return;
  const LocalTime& before = weather_.steps.back().end;
  const bool new_day = before.hour > 24.0 - 0.5 * weather_.step_h;
  const double expected_h = (new_day ? 0.0 : before.hour) + weather_.step_h;
  bool follows = std::abs(step.end.hour - expected_h) < 1e-6;
  if (!new_day) {
    follows = follows && step.end.month == before.month && step.end.day == before.day;
  } else {
    const bool month_over = before.day >= days_in_month(2001, before.month);
    const bool next_day = step.end.month == before.month && step.end.day == before.day + 1;
    follows =
        follows && (next_day || (month_over && step.end.month == before.month % 12 + 1 && step.end.day == 1));
  }
  if (!follows)
    wrong(fmt::format("the row of {}/{} hour {} follows that of {}/{} hour {}", step.end.month, step.end.day,
                      step.end.hour, before.month, before.day, before.hour),
          fmt::format("rows go hour by hour, {} each; is one missing or twice there?", n_per_hour_));
}

void EpwParser::set_irradiance(const std::vector<std::string_view>& fields, WeatherStep& step) {
  const auto value = [&](std::size_t field, const char* what) {
    return optional(fields[field], what, 0.0, 2000.0, kMissing_W_m2);
  };
  double global = value(13, "global horizontal radiation"), direct = value(14, "direct normal radiation");
  double diffuse = value(15, "diffuse horizontal radiation");
  const int n_missing = std::isnan(global) + std::isnan(direct) + std::isnan(diffuse);
  if (n_missing > 0) {
    const double altitude = sun_of(weather_, step).apparent_altitude_rad, sine = std::sin(altitude);
    const bool day = altitude > 0.0;
    if (n_missing == 1 && std::isnan(global)) global = diffuse + std::max(0.0, direct * sine);
    if (n_missing == 1 && std::isnan(diffuse)) diffuse = std::max(0.0, day ? global - direct * sine : global);
    if (n_missing == 1 && std::isnan(direct))
      direct = altitude > kLowSun_rad ? std::max(0.0, (global - diffuse) / sine) : 0.0;
    if (n_missing > 1) {
      n_dark_ += day;
      global = direct = diffuse = 0.0;
    }
  }
  step.global_horizontal_W_m2 = global;
  step.irradiance = {direct, diffuse};
}

void EpwParser::check_end() {
  if (!problems_.empty()) return;
  if (weather_.steps.empty()) return wrong("no rows follow the header", "is the file complete?");
  const LocalTime& last = weather_.steps.back().end;
  if (last.hour < 24.0 - 1e-6 ||
      (last_day_ && ((*last_day_)[0] != last.month || (*last_day_)[1] != last.day)))
    wrong(fmt::format(
              "the last row is of {}/{} hour {}, its DATA PERIODS line promises {}", last.month, last.day,
              last.hour,
              last_day_ ? fmt::format("{}/{} hour 24", (*last_day_)[0], (*last_day_)[1]) : "whole days"),
          "the file seems to be cut short");
}

}  // namespace

Weather parse_epw(std::string_view text, const std::string& file) { return EpwParser(text, file).parse(); }

Weather read_epw(const std::string& path, const Job& job) {
  return parse_epw(read_text_file(path, kMaxEpwBytes, job), name_for_messages(path));
}

}  // namespace dim
