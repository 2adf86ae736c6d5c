#pragma once

#include <string>
#include <vector>

#include "image/drawing.hpp"

namespace dim {

/// A line of a diagram with what is to be written on it. Pixels.
struct LabelledLine {
  std::vector<Vec2> points;
  bool closed = false;
  std::string label;
};

/// A rectangle of a diagram, pixels.
struct LabelBox {
  Vec2 low{0.0}, high{0.0};

  bool overlaps(const LabelBox& o) const {
    return low.x < o.high.x && o.low.x < high.x && low.y < o.high.y && o.low.y < high.y;
  }
};

/// Widths of words as common sans-serif fonts have them, for what is laid out without a font at hand, px.
double text_width_px(const std::string& utf8, int size_px);

/// The lines, each broken where its label stands, and the labels: level, centred on their lines where these
/// run straight, on long lines several, never on each other or on another line, and none on a line that has
/// no room for it.
/// @param within  what labels must stay in
/// @returns the places of the labels
std::vector<LabelBox> draw_labelled(const std::vector<LabelledLine>& lines, const LabelBox& within,
                                    int font_px, double width_px, const Rgb8& colour, Drawing& drawing);

}  // namespace dim
