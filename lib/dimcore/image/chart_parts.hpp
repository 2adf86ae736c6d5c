#pragma once

#include <string>

#include "image/drawing.hpp"
#include "image/scale.hpp"

/// What charts have in common.
namespace dim::chart {

inline constexpr Rgb8 kWords = {60, 60, 60};
inline constexpr int kFont_px = 12;
/// Of a legend's bar and numbers.
inline constexpr double kLegendWidth_px = 84.0;

void add_box(Drawing& drawing, double x0, double y0, double x1, double y1, Rgb8 colour);

/// A bar of colour_map with round numbers to its right and the unit above it.
/// @param at  its upper left corner
void add_legend(Drawing& drawing, const Scale& scale, const Vec2& at, double height_px, const std::string& unit);

}  // namespace dim::chart
