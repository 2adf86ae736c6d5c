#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dim {

/// Greatest width and height of a picture, pixels.
inline constexpr int kMaxPictureSide = 32768;

/// What a view shows, pixel by pixel, before any exposure. Row 0 is the top.
struct Raster {
  int width = 0;
  int height = 0;
  /// [height][width][3] CIE 1931 XYZ, Y in cd/m2 (absolute). Zero or NaN where nothing is seen.
  std::vector<float> xyz;
  /// [height][width] quantity for false colour, in scalar_unit; NaN where nothing is seen. May be empty.
  std::vector<float> scalar;
  /// "lx" (illuminance) or "cd/m²" (luminance).
  std::string scalar_unit;
  /// [height][width][n_bands] radiance in each waveband, W/(m2 sr); empty unless asked for.
  std::vector<float> radiance;
  /// [n_bands + 1] nm, edges of the wavebands of `radiance`.
  std::vector<double> band_edges_nm;

  std::size_t n_pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// A picture ready for a screen: [height][width][3] 8-bit display values, row 0 at the top.
struct Picture8 {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  std::size_t n_pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Checks that sizes and arrays belong together.
/// @throws LimitError     a side is below 1 or above kMaxPictureSide
/// @throws InternalError  xyz, or a non-empty scalar or radiance, has another size than the raster, or the
/// band
///                        edges do not increase
void check_raster(const Raster& raster);

}  // namespace dim
