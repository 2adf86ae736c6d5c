#include "image/stevens.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace dim {
namespace {

double log10_lamberts(double luminance_cd_m2) { return std::log10(luminance_cd_m2 / kLambert_cd_m2); }

Vec3 pixel_xyz(const Raster& raster, std::size_t pixel) {
  return {raster.xyz[3 * pixel], raster.xyz[3 * pixel + 1], raster.xyz[3 * pixel + 2]};
}

struct LogSum {
  double sum = 0;
  std::size_t n = 0;
};

LogSum log_sum_of_row(const Raster& raster, std::size_t row) {
  const auto width = static_cast<std::size_t>(raster.width);
  LogSum total;
  for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
    const Vec3 xyz = pixel_xyz(raster, i);
    if (!is_finite(xyz) || !(xyz.y > 0)) continue;
    total.sum += std::log10(xyz.y);
    ++total.n;
  }
  return total;
}

void map_row(const Raster& raster, std::size_t row, const BrightnessCurve& scene,
             const BrightnessCurve& screen, Raster& shown) {
  const auto width = static_cast<std::size_t>(raster.width);
  constexpr auto kGreatest = static_cast<double>(std::numeric_limits<float>::max());
  for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
    const Vec3 xyz = pixel_xyz(raster, i);
    if (!is_finite(xyz) || !(xyz.y > 0)) continue;
    const double shown_cd_m2 = std::min(display_luminance_cd_m2(xyz.y, scene, screen), kGreatest);
    const Vec3 mapped = xyz * (shown_cd_m2 / xyz.y);
    for (int c = 0; c < 3; ++c) {
      shown.xyz[3 * i + static_cast<std::size_t>(c)] =
          static_cast<float>(std::clamp(mapped[c], -kGreatest, kGreatest));
    }
  }
}

}  // namespace

BrightnessCurve stevens_curve(double adaptation_cd_m2) {
  constexpr double kSlope = 0.4;
  constexpr double kAtOneLambert = 2.92;
  const double darkest = (kDarkAdaptedExponent - kAtOneLambert) / kSlope;
  const double a = std::max(log10_lamberts(adaptation_cd_m2), darkest);
  return {kSlope * a + kAtOneLambert, -0.4 * a * a - 2.584 * a + 2.0208};
}

double brightness_stevens_bril(double luminance_cd_m2, const BrightnessCurve& curve) {
  if (!(luminance_cd_m2 > 0)) return 0.0;
  return std::pow(10.0, curve.alpha * log10_lamberts(luminance_cd_m2) + curve.beta);
}

double display_luminance_cd_m2(double scene_cd_m2, const BrightnessCurve& scene,
                               const BrightnessCurve& screen) {
  if (!(scene_cd_m2 > 0)) return 0.0;
  const double log10_bril = scene.alpha * log10_lamberts(scene_cd_m2) + scene.beta;
  return kLambert_cd_m2 * std::pow(10.0, (log10_bril - screen.beta) / screen.alpha);
}

std::optional<double> log_mean_luminance_cd_m2(const Raster& raster) {
  check_raster(raster);
  std::vector<LogSum> rows(static_cast<std::size_t>(raster.height));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) { rows[y] = log_sum_of_row(raster, y); });
  LogSum total;
  for (const LogSum& row : rows) {
    total.sum += row.sum;
    total.n += row.n;
  }
  if (total.n == 0) return std::nullopt;
  return std::pow(10.0, total.sum / static_cast<double>(total.n));
}

StevensResult map_brightness(const Raster& raster, const StevensOptions& options) {
  const double white = options.screen_white_cd_m2;
  if (!(white > 0) || !std::isfinite(white)) {
    throw InputError({{},
                      fmt::format("a screen's white of {} cd/m2 is not above 0", white),
                      "give what the screen emits where it shows white, for example 100"});
  }
  StevensResult result;
  result.screen_adaptation_cd_m2 = white * std::pow(10.0, -kWhiteOverMean_log10);
  result.scene_adaptation_cd_m2 = log_mean_luminance_cd_m2(raster).value_or(result.screen_adaptation_cd_m2);
  const BrightnessCurve scene = stevens_curve(result.scene_adaptation_cd_m2);
  const BrightnessCurve screen = stevens_curve(result.screen_adaptation_cd_m2);

  result.shown.width = raster.width;
  result.shown.height = raster.height;
  result.shown.xyz.assign(raster.xyz.size(), 0.0f);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(raster.height),
                    [&](std::size_t y) { map_row(raster, y, scene, screen, result.shown); });
  return result;
}

}  // namespace dim
