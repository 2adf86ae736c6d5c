#include "image/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "image/chart_parts.hpp"
#include "image/colour_map.hpp"

namespace dim {
namespace {

constexpr double kDay_px = 2.0, kDayHeight_px = 288.0;
constexpr double kLeft = 46.0, kTop = 34.0, kLegend = 26.0;

/// Steps of a day with one colour become one box, so that nights are not drawn by the hour.
void add_day(Drawing& drawing, const HeatMap& map, const Scale& scale, std::size_t day) {
  const auto n = static_cast<std::size_t>(map.steps_per_day);
  const double x = kLeft + kDay_px * static_cast<double>(day),
               height = kDayHeight_px / static_cast<double>(n);
  const auto colour = [&](std::size_t step) {
    return colour_map(scale.position(map.values[day * n + step]));
  };
  for (std::size_t step = 0; step < n;) {
    std::size_t end = step + 1;
    while (end < n && colour(end) == colour(step)) ++end;
    const double bottom = kTop + kDayHeight_px - height * static_cast<double>(step);
    chart::add_box(drawing, x, bottom - height * static_cast<double>(end - step), x + kDay_px, bottom, colour(step));
    step = end;
  }
}

void add_axes(Drawing& drawing, std::size_t n_days) {
  for (int hour = 0; hour <= 24; hour += 6)
    drawing.texts.push_back({{kLeft - 6.0, kTop + kDayHeight_px * (1.0 - hour / 24.0) + 4.0},
                             fmt::format("{:02}:00", hour),
                             chart::kFont_px,
                             TextAnchor::end,
                             chart::kWords});
  constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  constexpr double kMonthDays = 365.25 / 12.0;
  for (std::size_t month = 0; month < 12 && n_days >= 365; ++month)
    drawing.texts.push_back(
        {{kLeft + kDay_px * kMonthDays * (static_cast<double>(month) + 0.5), kTop + kDayHeight_px + 18.0},
         kMonths[month],
         chart::kFont_px,
         TextAnchor::middle,
         chart::kWords});
}

}  // namespace

Drawing heat_map_drawing(const HeatMap& map) {
  const std::size_t n_days = map.values.size() / static_cast<std::size_t>(map.steps_per_day);
  std::vector<float> positive;
  for (const double value : map.values)
    if (value > 0.0) positive.push_back(static_cast<float>(value));
  const Scale scale = automatic_scale(ScaleKind::logarithmic, positive);
  const double right = kLeft + kDay_px * static_cast<double>(n_days);
  Drawing drawing;
  drawing.width = static_cast<int>(right + kLegend + chart::kLegendWidth_px);
  drawing.height = static_cast<int>(kTop + kDayHeight_px + 34.0);
  drawing.title = map.title;
  drawing.texts.push_back({{kLeft, 18.0}, map.title, chart::kFont_px + 2, TextAnchor::start, chart::kWords});
  for (std::size_t day = 0; day < n_days; ++day) add_day(drawing, map, scale, day);
  add_axes(drawing, n_days);
  chart::add_legend(drawing, scale, {right + kLegend, kTop}, kDayHeight_px, map.unit);
  return drawing;
}

}  // namespace dim
