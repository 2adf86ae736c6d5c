#include "image/spectrum_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "spectrum/bands.hpp"

namespace dim {
namespace {

constexpr Rgb8 kGrid = {205, 205, 205};
constexpr Rgb8 kWords = {60, 60, 60};
constexpr Rgb8 kInk[] = {{0, 82, 155}, {200, 80, 0}, {70, 130, 40}};

}  // namespace

Drawing spectrum_diagram(const std::vector<NamedCurve>& curves, Rgb8 colour, const std::string& title,
                         int width_px, int height_px) {
  Drawing drawing;
  drawing.width = width_px;
  drawing.height = height_px;
  drawing.title = title;
  const int font = std::max(10, height_px / 32);
  const double left = 3.5 * font, right = width_px - 8.0 * font, top = 2.5 * font,
               bottom = height_px - 3.0 * font;
  const auto x_of = [&](double nm) {
    return left + (right - left) * (nm - kVisibleLow_nm) / (kVisibleHigh_nm - kVisibleLow_nm);
  };
  const auto y_of = [&](double value) { return bottom - (bottom - top) * std::clamp(value, 0.0, 1.0); };
  const auto word = [&](double x, double y, const std::string& text, TextAnchor anchor, const Rgb8& ink) {
    drawing.texts.push_back({{x, y}, text, font, anchor, ink});
  };

  for (int nm = 400; nm <= 750; nm += 50) {
    drawing.lines.push_back({{{x_of(nm), top}, {x_of(nm), bottom}}, 1.0, kGrid, false});
    word(x_of(nm), bottom + 1.4 * font, fmt::format("{}", nm), TextAnchor::middle, kWords);
  }
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double y = y_of(tenth / 10.0);
    drawing.lines.push_back({{{left, y}, {right, y}}, 1.0, kGrid, false});
    word(left - 0.4 * font, y + 0.35 * font, fmt::format("{:.1f}", tenth / 10.0), TextAnchor::end, kWords);
  }
  word(right, bottom + 2.6 * font, "nm", TextAnchor::end, kWords);
  word(0.6 * font, 1.4 * font, title, TextAnchor::start, kWords);

  const double field = right + 1.5 * font, field_end = width_px - 1.0 * font;
  drawing.areas.push_back(
      {{{field, top}, {field_end, top}, {field_end, top + 6.0 * font}, {field, top + 6.0 * font}}, colour});
  double legend = top + 8.0 * font;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Rgb8 ink = kInk[i % std::size(kInk)];
    DrawnLine line{{}, 2.5, ink, i > 0};
    for (double nm = kVisibleLow_nm; nm <= kVisibleHigh_nm; nm += 1.0)
      line.points.emplace_back(x_of(nm), y_of(curves[i].curve.at(nm)));
    drawing.lines.push_back(std::move(line));
    word(field, legend, curves[i].name, TextAnchor::start, ink);
    legend += 1.5 * font;
  }
  return drawing;
}

}  // namespace dim
