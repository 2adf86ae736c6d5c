#include "sky/calendar.hpp"

#include <cmath>

namespace dim {

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

double julian_day(const LocalTime& time, double time_zone_h) {
  // Days since 1 January 2000, noon of which is Julian day 2451545.
  const auto leap_days = [](int y) { return y / 4 - y / 100 + y / 400; };
  const int days = 365 * (time.year - 2000) + leap_days(time.year - 1) - leap_days(1999) +
                   day_of_year(time.year, time.month, time.day) - 1;
  return 2451544.5 + days + (time.hour - time_zone_h) / 24.0;
}

}  // namespace dim
