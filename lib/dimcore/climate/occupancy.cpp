#include "climate/occupancy.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

std::optional<double> number(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(" \t") - first + 1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// "HH:MM" or "MM-DD": two whole numbers.
std::optional<std::pair<int, int>> two_digits_twice(std::string_view text, char between) {
  if (text.size() != 5 || text[2] != between) return std::nullopt;
  const auto a = number(text.substr(0, 2)), b = number(text.substr(3, 2));
  if (!a || !b || *a != std::floor(*a) || *b != std::floor(*b) || *a < 0 || *b < 0) return std::nullopt;
  return std::pair{static_cast<int>(*a), static_cast<int>(*b)};
}

std::optional<double> clock_h(std::string_view text) {
  const auto parts = two_digits_twice(text, ':');
  if (!parts || parts->second > 59 || parts->first * 60 + parts->second > 24 * 60) return std::nullopt;
  return parts->first + parts->second / 60.0;
}

std::optional<MonthDay> month_day(std::string_view text) {
  const auto parts = two_digits_twice(text, '-');
  if (!parts || parts->first < 1 || parts->first > 12) return std::nullopt;
  if (parts->second < 1 || parts->second > days_in_month(2000, parts->first)) return std::nullopt;
  return MonthDay{parts->first, parts->second};
}

bool is_summer(const SummerTime& summer, const LocalTime& time) {
  const auto order = [](int month, int day) { return 32 * month + day; };
  const int now = order(time.month, time.day);
  const int first = order(summer.first.month, summer.first.day),
            last = order(summer.last.month, summer.last.day);
  return first <= last ? now >= first && now <= last : now >= first || now <= last;
}

}  // namespace

Schedule parse_hours(std::string_view text) {
  const auto dash = text.find('-');
  if (dash != std::string_view::npos) {
    const auto from = clock_h(text.substr(0, dash)), to = clock_h(text.substr(dash + 1));
    if (from && to && *from < *to) {
      Schedule schedule;
      schedule.from_h = *from;
      schedule.to_h = *to;
      return schedule;
    }
  }
  throw InputError(
      Problem{{}, fmt::format("hours '{}' are not two times of a day", text), "write 08:00-18:00"});
}

MonthDay parse_month_day(std::string_view text) {
  if (const auto day = month_day(text)) return *day;
  throw InputError(Problem{{}, fmt::format("'{}' is no day of a year", text), "write 03-29"});
}

SummerTime parse_summer_time(std::string_view text) {
  const auto comma = text.find(',');
  if (comma != std::string_view::npos) {
    const auto first = month_day(text.substr(0, comma)), last = month_day(text.substr(comma + 1));
    if (first && last) return {*first, *last};
  }
  throw InputError(Problem{{}, fmt::format("summer time '{}' is not two dates", text), "write 03-29,10-25"});
}

std::vector<bool> occupied_steps(const Weather& weather, const Schedule& schedule) {
  std::vector<bool> occupied(weather.steps.size());
  int weekday = weather.first_weekday;
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const LocalTime& end = weather.steps[i].end;
    if (i > 0 && end.day != weather.steps[i - 1].end.day) weekday = (weekday + 1) % 7;
    double clock = end.hour - 0.5 * weather.step_h;
    int day = weekday;
    if (schedule.summer_time && is_summer(*schedule.summer_time, end)) clock += 1.0;
    if (clock >= 24.0) {
      clock -= 24.0;
      day = (day + 1) % 7;
    }
    occupied[i] =
        schedule.days[static_cast<std::size_t>(day)] && clock >= schedule.from_h && clock < schedule.to_h;
  }
  return occupied;
}

std::vector<bool> parse_presence(std::string_view text, const std::string& file, std::size_t n_steps) {
  std::vector<bool> present;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int line = 1; !text.empty(); ++line) {
    const auto end = text.find('\n');
    std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (row.ends_with('\r')) row.remove_suffix(1);
    if (row.empty() || row.front() == '#') continue;
    const auto field = row.substr(row.find_last_of(",;\t") + 1);
    const auto value = number(field);
    if (!value && present.empty() && line == 1) continue;  // the header
    if (!value || *value < 0.0)
      throw InputError(
          Problem{{file, line}, fmt::format("presence '{}' is not a number of at least 0", field), ""});
    present.push_back(*value > 0.0);
  }
  if (present.size() != n_steps)
    throw InputError(
        Problem{{file},
                fmt::format("{} rows of presence for {} steps of weather", present.size(), n_steps),
                "write one row a step"});
  return present;
}

std::vector<bool> held_on(const std::vector<bool>& present, double hold_on_h, double step_h) {
  const auto n_hold = static_cast<long>(std::floor(hold_on_h / step_h + 1e-9));
  std::vector<bool> held(present.size());
  long n_since = n_hold + 1;
  for (std::size_t i = 0; i < present.size(); ++i) {
    n_since = present[i] ? 0 : n_since + 1;
    held[i] = n_since <= n_hold;
  }
  return held;
}

}  // namespace dim
