#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/raster.hpp"

/// Numbers as text that a web page can unpack: little-endian, deflated (RFC 1950), in base64.
namespace dim {

std::string base64(std::span<const std::byte> bytes);

/// @throws InternalError  what zlib says
std::string packed(std::span<const std::byte> bytes);
std::string packed(const std::vector<float>& values);
std::string packed(const std::vector<std::uint32_t>& values);
/// As float, whose rounding of 6e-8 no figure shows.
std::string packed(const std::vector<double>& values);

/// Codes of one picture channel by rows, as a page reads them: each the difference from its left neighbour (the first
/// of a row: from the one above), zigzag (0, -1, 1, -2 … as 0, 1, 2, 3 …), all low bytes and then all high bytes.
std::string packed_codes(const std::vector<std::uint16_t>& codes, int width);

/// A picture's light, small. Luminance on a logarithmic scale in steps of kLuminanceStep, so each pixel is
/// within half of that of the truth, which no display of 8 bits can show; chromaticity in steps of kChromaticityStep.
struct PackedPicture {
  int width = 0, height = 0;
  double greatest_cd_m2 = 0.0;  ///< 0: the picture is black, and nothing else is filled
  std::string luminance;        ///< codes c: 0 for none, else greatest * exp((c - kLuminanceCodes) * kLuminanceStep)
  bool one_colour = true;       ///< all lit pixels have the chromaticity (x, y)
  double x = 1.0 / 3.0, y = 1.0 / 3.0;
  std::string x_codes, y_codes;  ///< otherwise; times kChromaticityStep
};
inline constexpr int kLuminanceCodes = 16383;
inline constexpr double kLuminanceStep = 8.5e-4;  ///< 6 decades in all
inline constexpr double kChromaticityStep = 1.0 / 1024.0;

PackedPicture packed_picture(const Raster& raster);

}  // namespace dim
