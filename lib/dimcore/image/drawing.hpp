#pragma once

#include <string>
#include <vector>

#include "base/vec.hpp"
#include "image/legend.hpp"
#include "image/raster.hpp"

/// Diagrams of lines, areas and words, the same as SVG and as pixels.
namespace dim {

/// Lines from point to point. Coordinates are pixels from the upper left corner.
struct DrawnLine {
  std::vector<Vec2> points;
  double width_px = 1.0;
  Rgb8 colour{};
  bool dashed = false;
};

struct DrawnArea {
  std::vector<Vec2> outline;
  Rgb8 colour{};
  std::vector<std::vector<Vec2>> more_outlines{};  ///< holes and further parts: inside is what an odd number encloses
};

enum class TextAnchor { start, middle, end };

struct DrawnText {
  Vec2 at{0.0};  ///< on the baseline
  std::string utf8;
  int size_px = 14;
  TextAnchor anchor = TextAnchor::start;
  Rgb8 colour{};
  bool halo = false;  ///< on a rim of paper, to be read on lines
};

/// Areas lie below lines, lines below words; within each, later ones above earlier ones.
struct Drawing {
  int width = 0;
  int height = 0;
  std::string title;  ///< for SVG's readers
  std::vector<DrawnArea> areas;
  std::vector<DrawnLine> lines;
  std::vector<DrawnText> texts;
};

/// The drawing on white as an SVG file, coordinates to 0.01 pixel.
std::string svg_text(const Drawing& drawing);

/// The drawing on white as pixels, anti-aliased. Words are left out where the drawer has no font.
Picture8 rasterised(const Drawing& drawing, const TextDrawer& drawer);

}  // namespace dim
