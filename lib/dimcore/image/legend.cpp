#include "image/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dim {
namespace {

constexpr Rgb8 kPaper = {255, 255, 255};
constexpr Rgb8 kInk = {32, 32, 32};

struct Label {
  double position = 0;  // 0..1 along the bar
  std::string text;
};

// Lengths in pixels; y downwards.
struct Layout {
  int text_size = 0;
  int margin = 0;
  int bar_left = 0, bar_width = 0, bar_top = 0, bar_height = 0;
  int tick = 0;
  int label_left = 0;
  int width = 0, height = 0;
  int title_baseline = 0, unit_baseline = 0;
};

void fill(Picture8& picture, int x0, int y0, int x1, int y1, const Rgb8& colour) {
  for (int y = std::max(0, y0); y < std::min(picture.height, y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(picture.width, x1); ++x) {
      const auto at = 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x);
      std::copy(colour.begin(), colour.end(), picture.rgb.begin() + at);
    }
  }
}

int y_on_bar(const Layout& layout, double position) {
  return layout.bar_top + static_cast<int>(std::lround((1 - position) * (layout.bar_height - 1)));
}

// The ends and the labelled ticks between, from the bottom up.
std::vector<Label> labels_of(const std::vector<Tick>& marks, const FalseColourResult& painted) {
  const auto at_end = [](double position, double end) { return std::abs(position - end) < 1e-6; };
  Label low{0.0, fmt::format("{:.5g}", painted.scale.low)}, high{1.0, fmt::format("{:.5g}", painted.scale.high)};
  std::vector<Label> between;
  for (const Tick& tick : marks) {
    if (tick.label.empty()) continue;
    const double position = painted.scale.position(tick.value);
    if (at_end(position, 0.0))
      low.text = tick.label;
    else if (at_end(position, 1.0))
      high.text = tick.label;
    else
      between.push_back({position, tick.label});
  }
  if (painted.n_below > 0) low.text = "< " + low.text;
  if (painted.n_above > 0) high.text = "> " + high.text;
  between.insert(between.begin(), std::move(low));
  between.push_back(std::move(high));
  return between;
}

// From the bottom up, drops each label that would touch the one below it or the top one.
void drop_touching(std::vector<Label>& labels, const Layout& layout) {
  const int apart = layout.text_size + layout.text_size / 4;
  const int top = y_on_bar(layout, labels.back().position);
  std::vector<Label> kept{labels.front()};
  for (std::size_t i = 1; i + 1 < labels.size(); ++i) {
    const int y = y_on_bar(layout, labels[i].position);
    if (y_on_bar(layout, kept.back().position) - y >= apart && y - top >= apart)
      kept.push_back(std::move(labels[i]));
  }
  if (y_on_bar(layout, 0.0) - top >= apart) kept.push_back(std::move(labels.back()));
  labels = std::move(kept);
}

void lay_out_vertically(Layout& layout, int picture_height, bool has_title, bool has_unit, bool has_text) {
  layout.height = std::max(picture_height, kMinLegendHeight);
  layout.text_size = std::clamp(static_cast<int>(std::lround(layout.height / 42.0)), 12, 48);
  layout.margin = layout.text_size;
  layout.tick = std::max(3, layout.text_size / 3);
  layout.bar_width = layout.text_size * 3 / 2;
  const int line = layout.text_size * 7 / 5;
  int y = layout.margin;
  if (has_text && has_title) {
    layout.title_baseline = y + layout.text_size * 4 / 5;
    y += line;
  }
  if (has_text && has_unit) {
    layout.unit_baseline = y + layout.text_size * 4 / 5;
    y += line;
  }
  // Room for the half of the top label that stands above the bar's end.
  layout.bar_top = y + layout.text_size / 2;
  layout.bar_height = std::max(16, layout.height - layout.margin - layout.text_size / 2 - layout.bar_top);
}

void lay_out_horizontally(Layout& layout, int picture_width, int widest_label, int widest_heading) {
  layout.bar_left = picture_width + layout.margin;
  layout.label_left = layout.bar_left + layout.bar_width + layout.tick + layout.text_size / 3;
  const int right = std::max(layout.label_left + widest_label, layout.bar_left + widest_heading);
  layout.width = right + layout.margin;
}

void draw_bar(Picture8& sheet, const Layout& layout, const std::vector<Tick>& marks, const Scale& scale) {
  const int left = layout.bar_left;
  const int right = left + layout.bar_width;
  fill(sheet, left - 1, layout.bar_top - 1, right + 1, layout.bar_top + layout.bar_height + 1, kInk);
  for (int i = 0; i < layout.bar_height; ++i) {
    const double position = 1 - i / (layout.bar_height - 1.0);
    fill(sheet, left, layout.bar_top + i, right, layout.bar_top + i + 1, colour_map(position));
  }
  const int thickness = std::max(1, layout.text_size / 14);
  for (const Tick& tick : marks) {
    const int y = y_on_bar(layout, scale.position(tick.value)) - thickness / 2;
    const int length = tick.label.empty() ? layout.tick / 2 : layout.tick;
    fill(sheet, right + 1, y, right + 1 + length, y + thickness, kInk);
  }
}

void draw_words(Picture8& sheet, const Layout& layout, const std::vector<Label>& labels,
                const std::string& title, const std::string& unit, const TextDrawer& text) {
  const int half_digit = (text.measure("0", layout.text_size).above + 1) / 2;
  for (const Label& label : labels) {
    text.draw(sheet, layout.label_left, y_on_bar(layout, label.position) + half_digit, label.text,
              layout.text_size, kInk);
  }
  if (!title.empty()) text.draw(sheet, layout.bar_left, layout.title_baseline, title, layout.text_size, kInk);
  if (!unit.empty()) text.draw(sheet, layout.bar_left, layout.unit_baseline, unit, layout.text_size, kInk);
}

}  // namespace

Picture8 with_legend(const FalseColourResult& painted, const std::string& title, const std::string& unit,
                     const TextDrawer& text) {
  const Picture8& picture = painted.picture;
  const bool words = text.available();
  Layout layout;
  lay_out_vertically(layout, picture.height, !title.empty(), !unit.empty(), words);

  const std::vector<Tick> marks =
      ticks(painted.scale, std::clamp(layout.bar_height / (2 * layout.text_size) + 1, 2, 11));
  std::vector<Label> labels = labels_of(marks, painted);
  drop_touching(labels, layout);
  int widest_label = 0;
  int widest_heading = 0;
  if (words) {
    const auto width_of = [&](const std::string& s) { return text.measure(s, layout.text_size).width; };
    for (const Label& label : labels) widest_label = std::max(widest_label, width_of(label.text));
    for (const std::string& s : {title, unit}) {
      if (!s.empty()) widest_heading = std::max(widest_heading, width_of(s));
    }
  }
  lay_out_horizontally(layout, picture.width, widest_label, widest_heading);

  Picture8 sheet{layout.width, layout.height, {}};
  sheet.rgb.assign(3 * sheet.n_pixels(), 255);
  fill(sheet, 0, 0, sheet.width, sheet.height, kPaper);
  const auto row = static_cast<std::ptrdiff_t>(3) * picture.width;
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(picture.rgb.begin() + y * row, row,
                sheet.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * sheet.width);
  }
  draw_bar(sheet, layout, marks, painted.scale);
  if (words) draw_words(sheet, layout, labels, title, unit, text);
  return sheet;
}

}  // namespace dim
