#pragma once

#include <array>
#include <cstdint>

namespace dim {

using Rgb8 = std::array<std::uint8_t, 3>;

/// Colour for a position 0..1 on a false-colour scale, sRGB coded; positions outside are clamped.
///
/// Made by formula, so that equal steps of the value look like equal steps of lightness and the order can be
/// read even in grey print: CIELAB (D65) lightness runs linearly from 14 to 92 while the hue turns from
/// violet over blue and green to yellow, at chromas that stay inside sRGB. 256 colours.
Rgb8 colour_map(double position);

/// For pixels where there is no value: a grey the map does not contain.
inline constexpr Rgb8 kNoValueColour = {214, 214, 214};

}  // namespace dim
