#pragma once

#include <cstdint>
#include <vector>

#include "image/module/abi.hpp"

/// Inside the picture module: files as bytes. All throw std::runtime_error with the library's own words.
namespace dim::image_module {

/// 8-bit sRGB PNG with sRGB, gAMA and cHRM chunks.
std::vector<std::uint8_t> encode_png(const DimImagePicture& picture);

/// Radiance RGBE, run-length coded, with PRIMARIES, EXPOSURE=1, SOFTWARE and VIEW lines.
/// RGBE mantissas are cut off, as the format means them: readers that add half a step (Radiance) are
/// unbiased.
std::vector<std::uint8_t> encode_radiance(const DimImagePicture& picture);

/// OpenEXR, 32-bit float, ZIP; channels R, G, B and, with four, luminance.Y; attributes chromaticities,
/// whiteLuminance, adoptedNeutral, unit, software, comments; then the further channels and attributes.
std::vector<std::uint8_t> encode_exr(const DimImagePicture& picture);

}  // namespace dim::image_module
