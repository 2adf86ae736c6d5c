#include "image/heat_map.hpp"

#include "catch.hpp"

using namespace dim;

TEST_CASE("A heat map has days across and hours up", "[image][unit]") {
  HeatMap map;
  map.title = "desk[0]";
  map.unit = "lx";
  map.steps_per_day = 24;
  map.values.assign(2 * 24, 0.0);
  map.values[24 + 12] = 1000.0;  // noon of the second day
  const Drawing drawing = heat_map_drawing(map);
  const Rgb8 bright = colour_map(1.0), dark = colour_map(0.0);
  int n_bright = 0;
  for (const auto& area : drawing.areas) {
    if (area.colour != bright || area.outline[0].x > drawing.width / 2.0) continue;
    ++n_bright;
    // The hour from 12:00 to 13:00 of a day that is 24 hours high.
    const double low = area.outline[2].y, high = area.outline[0].y;
    const double night_low = drawing.areas.front().outline[2].y, day_px = (low - high) * 24.0;
    CHECK((night_low - low) / day_px == Approx(0.5));
    CHECK(area.outline[0].x > drawing.areas.front().outline[0].x);
  }
  CHECK(n_bright == 1);
  CHECK(drawing.areas.front().colour == dark);
  CHECK(svg_text(drawing).find("desk[0]") != std::string::npos);
}
