#pragma once

#include "image/module/abi.hpp"

/// Inside the picture module: text on 8-bit pictures. ASCII and the superscripts ¹ ² ³ ⁰; another character
/// is drawn as a question mark.
namespace dim::image_module {

/// @throws std::runtime_error  no font is installed
DimImageExtent measure_text(const DimImageText& text);

/// @throws std::runtime_error  no font is installed
void draw_text(const DimImageText& text, std::uint8_t* rgb, int width, int height);

}  // namespace dim::image_module
