#pragma once

#include <optional>
#include <string_view>

namespace dim {

/// A moment on the clock of a place that keeps one time zone all year (local standard time).
struct LocalTime {
  int year = 2001;
  int month = 1;      ///< 1..12
  int day = 1;        ///< 1..31
  double hour = 0.0;  ///< from midnight; may leave 0..24, the days run on
};

bool is_leap_year(int year);
/// 28..31. @param month 1..12
int days_in_month(int year, int month);
/// 1..366
int day_of_year(int year, int month, int day);
/// The date of a day of the year, hour 0. @param day  1..365, in leap years 366
LocalTime date_of(int year, int day);

/// "2001-06-21T09:30", years 1950..2050, up to 24:00; nothing for any other text.
std::optional<LocalTime> parse_local_time(std::string_view text);

/// Julian day number and fraction, universal time, of the Gregorian calendar.
/// @param time_zone_h  hours east of Greenwich
double julian_day(const LocalTime& time, double time_zone_h);

}  // namespace dim
