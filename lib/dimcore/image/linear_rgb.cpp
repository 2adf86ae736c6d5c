#include "image/linear_rgb.hpp"

#include <limits>

namespace dim {
namespace {

template <typename Store>
LinearPicture convert(const Raster& raster, const Primaries& primaries, int n_channels, const Store& store) {
  check_raster(raster);
  LinearPicture picture;
  picture.width = raster.width;
  picture.height = raster.height;
  picture.n_channels = n_channels;
  picture.primaries = primaries;
  picture.values.assign(raster.n_pixels() * static_cast<std::size_t>(n_channels), 0.0f);
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    const Vec3 xyz(raster.xyz[3 * i], raster.xyz[3 * i + 1], raster.xyz[3 * i + 2]);
    if (is_finite(xyz)) store(xyz, &picture.values[i * static_cast<std::size_t>(n_channels)], picture);
  }
  return picture;
}

void put(const Vec3& rgb, float* out) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(rgb[c]);
}

}  // namespace

LinearPicture radiance_pixels(const Raster& raster) {
  const glm::dmat3 to_rgb = (1.0 / kRadianceEfficacy_lm_W) * xyz_to_rgb(kRadiancePrimaries);
  const Vec3 weights = luminance_weights(kRadiancePrimaries);
  return convert(raster, kRadiancePrimaries, 3, [&](const Vec3& xyz, float* out, LinearPicture& picture) {
    const InGamut inside = bring_into_gamut(to_rgb * xyz, weights, std::numeric_limits<double>::infinity());
    picture.n_out_of_gamut += inside.out_of_gamut;
    put(inside.rgb, out);
  });
}

LinearPicture exr_pixels(const Raster& raster, const Vec3& scene_white_xyz) {
  Primaries primaries = kSrgbPrimaries;
  primaries.white = chromaticity_of(neutral_white(scene_white_xyz, kSrgbPrimaries));
  const glm::dmat3 to_rgb = xyz_to_rgb(primaries);
  return convert(raster, primaries, 4, [&](const Vec3& xyz, float* out, LinearPicture&) {
    put(to_rgb * xyz, out);
    out[3] = static_cast<float>(xyz.y);
  });
}

}  // namespace dim
