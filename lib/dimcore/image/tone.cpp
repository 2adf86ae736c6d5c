#include "image/tone.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

struct RowCount {
  std::size_t above_white = 0;
  std::size_t out_of_gamut = 0;
};

std::uint8_t quantise(double linear, double threshold) {
  // A level that is a whole step but for rounding is not dithered.
  constexpr double kWhole = 1e-3;
  const double steps = 255.0 * srgb_encode(linear);
  return static_cast<std::uint8_t>(
      std::min(255.0, std::floor(steps + kWhole + (1 - 2 * kWhole) * threshold)));
}

double given_or_automatic_white(const Raster& raster, const ToneOptions& options) {
  if (!options.display_white_cd_m2) return automatic_display_white_cd_m2(raster);
  const double white = *options.display_white_cd_m2;
  if (!(white > 0) || !std::isfinite(white)) {
    throw InputError({{},
                      fmt::format("exposure {} cd/m2 is not above 0", white),
                      "give the luminance that is to appear as white, for example 200"});
  }
  return white;
}

struct Display {
  glm::dmat3 from_xyz;
  Vec3 weights;
  bool roll_off, dither;
};

RowCount tone_row(const Raster& raster, int y, const Display& display, Picture8& picture) {
  RowCount count;
  for (int x = 0; x < raster.width; ++x) {
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) +
                                static_cast<std::size_t>(x));
    const Vec3 xyz(raster.xyz[at], raster.xyz[at + 1], raster.xyz[at + 2]);
    if (!is_finite(xyz)) continue;
    Vec3 rgb = display.from_xyz * xyz;
    const double luminance = glm::dot(rgb, display.weights);
    if (display.roll_off && luminance > kShoulder) rgb *= rolled_off(luminance) / luminance;
    const InGamut shown = bring_into_gamut(rgb, display.weights);
    count.above_white += shown.above_white || (display.roll_off && luminance > 1.0);
    count.out_of_gamut += shown.out_of_gamut;
    const double threshold = display.dither ? dither_threshold(x, y) : 0.5;
    for (int i = 0; i < 3; ++i) {
      picture.rgb[at + static_cast<std::size_t>(i)] = quantise(shown.rgb[i], threshold);
    }
  }
  return count;
}

}  // namespace

double dither_threshold(int x, int y) {
  const auto fraction = [](double v) { return v - std::floor(v); };
  return fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
}

double automatic_display_white_cd_m2(const Raster& raster) {
  constexpr double kQuantile = 0.90;
  constexpr double kDarkest = 1e-3;  // of that quantile: what is darker counts as that
  std::vector<float> seen;
  seen.reserve(raster.n_pixels());
  for (std::size_t i = 1; i < raster.xyz.size(); i += 3) {
    if (raster.xyz[i] > 0 && std::isfinite(raster.xyz[i])) seen.push_back(raster.xyz[i]);
  }
  if (seen.empty()) return 1.0;
  const auto rank = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(seen.size() - 1));
  std::nth_element(seen.begin(), seen.begin() + rank, seen.end());
  const double bright = static_cast<double>(seen[static_cast<std::size_t>(rank)]);
  double sum = 0.0;
  for (std::ptrdiff_t i = 0; i <= rank; ++i)
    sum += std::log(std::max(static_cast<double>(seen[static_cast<std::size_t>(i)]) / bright, kDarkest));
  const double key = bright * std::exp(sum / static_cast<double>(rank + 1));
  return std::max(key / kAutoKey, bright / kAutoMostAbove);
}

double rolled_off(double luminance) {
  if (luminance <= kShoulder) return luminance;
  const double t = (luminance - kShoulder) / (1.0 - kShoulder);
  return kShoulder + (1.0 - kShoulder) * t / (1.0 + t);
}

ToneResult tone_linear(const Raster& raster, const ToneOptions& options) {
  check_raster(raster);
  ToneResult result;
  result.display_white_cd_m2 = given_or_automatic_white(raster, options);
  const Vec3 white = neutral_white(options.scene_white_xyz, options.display);
  const glm::dmat3 adapt = bradford_adaptation(white, xyz_of(options.display.white));
  const Display display{(1.0 / result.display_white_cd_m2) * (xyz_to_rgb(options.display) * adapt),
                        luminance_weights(options.display), !options.display_white_cd_m2, options.dither};

  result.picture.width = raster.width;
  result.picture.height = raster.height;
  result.picture.rgb.assign(3 * raster.n_pixels(), 0);
  std::vector<RowCount> counts(static_cast<std::size_t>(raster.height));
  tbb::parallel_for(0, raster.height, [&](int y) {
    counts[static_cast<std::size_t>(y)] = tone_row(raster, y, display, result.picture);
  });
  for (const RowCount& count : counts) {
    result.n_above_white += count.above_white;
    result.n_out_of_gamut += count.out_of_gamut;
  }
  return result;
}

}  // namespace dim
