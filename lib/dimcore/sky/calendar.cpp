#include "sky/calendar.hpp"

#include <charconv>

namespace dim {
namespace {

constexpr int kFirstYear = 1950, kLastYear = 2050;

/// A whole number of exactly these digits within limits; -1 for anything else.
int digits(std::string_view text, int least, int greatest) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && stop == text.data() + text.size() && text.front() != '-';
  return whole && value >= least && value <= greatest ? value : -1;
}

}  // namespace

bool is_leap_year(int year) { return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0; }

int days_in_month(int year, int month) {
  if (month == 2) return is_leap_year(year) ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

int day_of_year(int year, int month, int day) {
  int days = day;
  for (int m = 1; m < month; ++m) days += days_in_month(year, m);
  return days;
}

LocalTime date_of(int year, int day) {
  int month = 1;
  while (month < 12 && day > days_in_month(year, month)) day -= days_in_month(year, month++);
  return {year, month, day, 0.0};
}

std::optional<LocalTime> parse_local_time(std::string_view text) {
  if (text.size() != 16 || text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':') return std::nullopt;
  const int year = digits(text.substr(0, 4), kFirstYear, kLastYear), month = digits(text.substr(5, 2), 1, 12);
  const int hour = digits(text.substr(11, 2), 0, 24), minute = digits(text.substr(14, 2), 0, hour == 24 ? 0 : 59);
  if (year < 0 || month < 0 || hour < 0 || minute < 0) return std::nullopt;
  const int day = digits(text.substr(8, 2), 1, days_in_month(year, month));
  if (day < 0) return std::nullopt;
  return LocalTime{year, month, day, hour + minute / 60.0};
}

double julian_day(const LocalTime& time, double time_zone_h) {
  // Days since 1 January 2000, noon of which is Julian day 2451545.
  const auto leap_days = [](int y) { return y / 4 - y / 100 + y / 400; };
  const int days = 365 * (time.year - 2000) + leap_days(time.year - 1) - leap_days(1999) +
                   day_of_year(time.year, time.month, time.day) - 1;
  return 2451544.5 + days + (time.hour - time_zone_h) / 24.0;
}

}  // namespace dim
