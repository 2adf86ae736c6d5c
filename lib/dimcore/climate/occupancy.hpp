#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sky/epw.hpp"

namespace dim {

/// A day of the year without its year.
struct MonthDay {
  int month = 1, day = 1;
};

/// The part of the year with clocks an hour ahead of standard time; it may run over the new year.
struct SummerTime {
  MonthDay first, last;  ///< both with it
};

/// Hours and days of a week when a place is used.
struct Schedule {
  double from_h = 8.0;                                                    ///< 0..24
  double to_h = 18.0;                                                     ///< from_h..24
  std::array<bool, 7> days = {true, true, true, true, true, true, true};  ///< Monday .. Sunday
  std::optional<SummerTime> summer_time;  ///< none: hours are of standard time
};

/// "08:00-18:00". @throws InputError  without a place
Schedule parse_hours(std::string_view text);
/// "03-29". @throws InputError  without a place
MonthDay parse_month_day(std::string_view text);
/// "03-29,10-25". @throws InputError  without a place
SummerTime parse_summer_time(std::string_view text);

/// Which steps of the weather are occupied; what counts is the middle of a step. [n_steps]
std::vector<bool> occupied_steps(const Weather& weather, const Schedule& schedule);

/// Presence from a CSV: the last field of every row, above 0 for somebody there, a step a row; a header row
/// may stand first. [n_steps] @throws InputError  not a number, more or fewer rows than steps
std::vector<bool> parse_presence(std::string_view text, const std::string& file, std::size_t n_steps);

/// Presence prolonged: as long as somebody was there within the time before.
std::vector<bool> held_on(const std::vector<bool>& present, double hold_on_h, double step_h);

}  // namespace dim
