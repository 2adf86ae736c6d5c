#include "image/chart_parts.hpp"

#include "image/colour_map.hpp"

namespace dim::chart {

void add_box(Drawing& drawing, double x0, double y0, double x1, double y1, Rgb8 colour) {
  drawing.areas.push_back({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, colour});
}

void add_legend(Drawing& drawing, const Scale& scale, const Vec2& at, double height_px, const std::string& unit) {
  constexpr int kSteps = 64;
  constexpr double kBar_px = 14.0;
  for (int i = 0; i < kSteps; ++i) {
    const double top = at.y + height_px * (1.0 - (i + 1.0) / kSteps);
    add_box(drawing, at.x, top, at.x + kBar_px, top + height_px / kSteps, colour_map((i + 0.5) / kSteps));
  }
  for (const auto& tick : ticks(scale, 7))
    if (!tick.label.empty())
      drawing.texts.push_back({{at.x + kBar_px + 6.0, at.y + height_px * (1.0 - scale.position(tick.value)) + 4.0},
                               tick.label,
                               kFont_px,
                               TextAnchor::start,
                               kWords});
  drawing.texts.push_back({{at.x, at.y - 10.0}, unit, kFont_px, TextAnchor::start, kWords});
}

}  // namespace dim::chart
