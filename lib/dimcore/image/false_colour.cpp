#include "image/false_colour.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/error.hpp"

namespace dim {
namespace {

Scale scale_for(const Raster& raster, const FalseColourOptions& options) {
  Scale scale{options.kind, 0, 1};
  if (!options.low || !options.high) {
    std::vector<float> finite;
    finite.reserve(raster.scalar.size());
    std::copy_if(raster.scalar.begin(), raster.scalar.end(), std::back_inserter(finite),
                 [](float v) { return std::isfinite(v); });
    scale = automatic_scale(options.kind, std::move(finite));
  }
  if (options.low) scale.low = *options.low;
  if (options.high) scale.high = *options.high;
  // One end given, beyond everything there is: keep the given one, and a scale.
  if (options.low && !options.high && scale.high <= scale.low) {
    scale.high = options.kind == ScaleKind::linear ? scale.low + 1 : scale.low * 10;
  }
  if (options.high && !options.low && scale.low >= scale.high && scale.high > 0) {
    scale.low = options.kind == ScaleKind::linear ? 0 : scale.high / 10;
  }
  check_scale(scale);
  return scale;
}

}  // namespace

FalseColourResult false_colour(const Raster& raster, const FalseColourOptions& options) {
  check_raster(raster);
  if (raster.scalar.empty())
    throw InternalError("a false-colour picture was asked of a raster without values");
  FalseColourResult result;
  result.scale = scale_for(raster, options);
  result.picture.width = raster.width;
  result.picture.height = raster.height;
  result.picture.rgb.resize(3 * raster.n_pixels());
  // What float cannot tell from the end of the scale is not outside it.
  constexpr double kRounding = 1e-6;
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    Rgb8 colour = kNoValueColour;
    if (!std::isnan(raster.scalar[i])) {
      const double position = result.scale.position(static_cast<double>(raster.scalar[i]));
      result.n_below += position < -kRounding;
      result.n_above += position > 1 + kRounding;
      colour = colour_map(position);
    }
    std::copy(colour.begin(), colour.end(), result.picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return result;
}

}  // namespace dim
