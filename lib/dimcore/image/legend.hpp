#pragma once

#include <string>

#include "image/false_colour.hpp"
#include "image/raster.hpp"

namespace dim {

/// Size of a line of text as drawn, pixels. above + below the baseline; all 0 where nothing can be drawn.
struct TextExtent {
  int width = 0;
  int above = 0;
  int below = 0;
};

/// Draws text on pictures. The picture module (OpenImageIO, FreeType) supplies one.
class TextDrawer {
 public:
  virtual ~TextDrawer() = default;
  /// @returns false where there is no font: then nothing can be drawn
  virtual bool available() const = 0;
  virtual TextExtent measure(const std::string& utf8, int size_px) const = 0;
  /// ASCII and the superscripts ¹ ² ³ ⁰; anything else comes out as a question mark.
  /// Draws with the left end of the baseline at (x, y), anti-aliased, clipped to the picture.
  virtual void draw(Picture8& picture, int x, int y, const std::string& utf8, int size_px,
                    Rgb8 colour) const = 0;
};

/// The false-colour picture with a legend bar to its right, on white: title and unit above, ticks and round
/// numbers beside it; the first and last labels say < or > where pixels lie beyond the scale. Text grows with
/// the picture's height. The result is wider than the picture, and as high (at least kMinLegendHeight).
/// Without a font the bar and its ticks are drawn, without words.
Picture8 with_legend(const FalseColourResult& painted, const std::string& title, const std::string& unit,
                     const TextDrawer& text);

inline constexpr int kMinLegendHeight = 120;

}  // namespace dim
