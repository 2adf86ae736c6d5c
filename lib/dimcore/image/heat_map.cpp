#include "image/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "image/colour_map.hpp"
#include "image/scale.hpp"

namespace dim {
namespace {

constexpr Rgb8 kWords = {60, 60, 60};
constexpr double kDay_px = 2.0, kDayHeight_px = 288.0;
constexpr double kLeft = 46.0, kTop = 34.0, kLegend = 26.0, kLegendWidth = 14.0;
constexpr int kFont = 12;
constexpr int kLegendSteps = 64;

void add_box(Drawing& drawing, double x0, double y0, double x1, double y1, Rgb8 colour) {
  drawing.areas.push_back({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, colour});
}

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
    add_box(drawing, x, bottom - height * static_cast<double>(end - step), x + kDay_px, bottom, colour(step));
    step = end;
  }
}

void add_axes(Drawing& drawing, std::size_t n_days) {
  for (int hour = 0; hour <= 24; hour += 6)
    drawing.texts.push_back({{kLeft - 6.0, kTop + kDayHeight_px * (1.0 - hour / 24.0) + 4.0},
                             fmt::format("{:02}:00", hour),
                             kFont,
                             TextAnchor::end,
                             kWords});
  constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  constexpr double kMonthDays = 365.25 / 12.0;
  for (std::size_t month = 0; month < 12 && n_days >= 365; ++month)
    drawing.texts.push_back(
        {{kLeft + kDay_px * kMonthDays * (static_cast<double>(month) + 0.5), kTop + kDayHeight_px + 18.0},
         kMonths[month],
         kFont,
         TextAnchor::middle,
         kWords});
}

void add_legend(Drawing& drawing, const Scale& scale, double left, const std::string& unit) {
  for (int i = 0; i < kLegendSteps; ++i) {
    const double top = kTop + kDayHeight_px * (1.0 - (i + 1.0) / kLegendSteps);
    add_box(drawing, left, top, left + kLegendWidth, top + kDayHeight_px / kLegendSteps,
            colour_map((i + 0.5) / kLegendSteps));
  }
  for (const auto& tick : ticks(scale, 7))
    if (!tick.label.empty())
      drawing.texts.push_back(
          {{left + kLegendWidth + 6.0, kTop + kDayHeight_px * (1.0 - scale.position(tick.value)) + 4.0},
           tick.label,
           kFont,
           TextAnchor::start,
           kWords});
  drawing.texts.push_back({{left, kTop - 10.0}, unit, kFont, TextAnchor::start, kWords});
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
  drawing.width = static_cast<int>(right + kLegend + kLegendWidth + 70.0);
  drawing.height = static_cast<int>(kTop + kDayHeight_px + 34.0);
  drawing.title = map.title;
  drawing.texts.push_back({{kLeft, 18.0}, map.title, kFont + 2, TextAnchor::start, kWords});
  for (std::size_t day = 0; day < n_days; ++day) add_day(drawing, map, scale, day);
  add_axes(drawing, n_days);
  add_legend(drawing, scale, right + kLegend, map.unit);
  return drawing;
}

}  // namespace dim
