#pragma once

#include <cstddef>
#include <vector>

#include "image/colour_space.hpp"
#include "image/raster.hpp"

namespace dim {

/// Luminous efficacy that the Radiance picture format takes between its pixels (W/(m2 sr), summed over the
/// visible range) and luminance, lm/W.
inline constexpr double kRadianceEfficacy_lm_W = 179.0;

/// Linear values for a high dynamic range file: [height][width][n_channels], row 0 at the top.
struct LinearPicture {
  int width = 0;
  int height = 0;
  int n_channels = 3;
  Primaries primaries;
  std::vector<float> values;
  std::size_t n_out_of_gamut = 0;  ///< pixels with a negative component, brought in at constant luminance
};

/// Pixels for a Radiance picture: kRadiancePrimaries, W/(m2 sr); luminance = 179 * (weights . RGB) cd/m2.
/// Not adapted. The format has no negative values: such pixels are brought in along constant hue and counted.
/// NaN and infinity become 0.
LinearPicture radiance_pixels(const Raster& raster);

/// Pixels for an OpenEXR picture, channels R, G, B and Y: R = G = B = 1 is 1 cd/m2 of the scene's white.
/// The primaries are those of BT.709 with the scene's white as their white: a grey room is grey without any
/// adaptation, and XYZ follows exactly from the file's chromaticities. A scene's white outside BT.709 gives
/// way to D65 (neutral_white). Negative components are kept. NaN and
/// infinity become 0. Y is the luminance in cd/m2.
LinearPicture exr_pixels(const Raster& raster, const Vec3& scene_white_xyz);

}  // namespace dim
