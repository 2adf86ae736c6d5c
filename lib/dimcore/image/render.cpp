#include "image/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/low_discrepancy.hpp"
#include "geometry/perspective.hpp"

namespace dim {
namespace {

struct Pixel {
  Light light;
  double scalar = 0.0;
  int n_scalar = 0;
};

class Renderer {
 public:
  Renderer(const Shader& shader, const RenderOptions& options)
      : shader_(shader),
        options_(options),
        perspective_({options.view.eye, options.view.focus, options.view.up, options.view.fov_rad,
                      options.view.width, options.view.height}) {}

  Pixel pixel(int x, int y) const {
    const int n = options_.samples;
    Pixel sum;
    sum.light.assign(shader_.channels().size(), 0.0);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto chance =
            mix(static_cast<std::uint64_t>(((y * n + j) * static_cast<std::int64_t>(1) << 32) + x * n + i));
        add(sum, x + (i + 0.5) / n, y + (j + 0.5) / n, chance);
      }
    }
    for (double& value : sum.light) value /= n * n;
    return sum;
  }

  double luminance_cd_m2(const Light& light) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < light.size(); ++c) sum += shader_.channels().xyz(c).y * light[c];
    return sum;
  }

 private:
  void add(Pixel& sum, double px, double py, std::uint64_t chance) const {
    const bool luminance = options_.scalar == ScalarQuantity::luminance;
    const double before = luminance ? luminance_cd_m2(sum.light) : 0.0;
    const auto seen = shader_.seen(options_.view.eye, perspective_.direction(px, py), chance, sum.light);
    if (luminance ? !seen.anything : !seen.surface) return;
    sum.scalar += luminance ? luminance_cd_m2(sum.light) - before : seen.illuminance_lx;
    ++sum.n_scalar;
  }

  const Shader& shader_;
  const RenderOptions& options_;
  Perspective perspective_;
};

void store(const Pixel& pixel, const LightChannels& channels, std::size_t at, Raster& raster) {
  Vec3 xyz(0.0);
  for (std::size_t c = 0; c < channels.size(); ++c) xyz += pixel.light[c] * channels.xyz(c);
  for (int axis = 0; axis < 3; ++axis)
    raster.xyz[at * 3 + static_cast<std::size_t>(axis)] = static_cast<float>(xyz[axis]);
  raster.scalar[at] = pixel.n_scalar > 0 ? static_cast<float>(pixel.scalar / pixel.n_scalar)
                                         : std::numeric_limits<float>::quiet_NaN();
  for (std::size_t c = 0; c < channels.size() && !raster.radiance.empty(); ++c)
    raster.radiance[at * channels.n_bands() + channels.band(c)] += static_cast<float>(pixel.light[c]);
}

// The pages of a large picture take seconds to be had: the stop flag is looked at meanwhile.
void grow(std::vector<float>& values, std::size_t n, const Job& job) {
  constexpr std::size_t kStep = std::size_t{1} << 22;
  values.reserve(n);
  while (values.size() < n) {
    job.check();
    values.resize(std::min(n, values.size() + kStep));
  }
}

}  // namespace

Raster render_view(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                   const RenderOptions& options, const Job& job) {
  Raster raster;
  raster.width = options.view.width;
  raster.height = options.view.height;
  raster.scalar_unit = options.scalar == ScalarQuantity::illuminance ? "lx" : "cd/m²";
  grow(raster.xyz, raster.n_pixels() * 3, job);
  grow(raster.scalar, raster.n_pixels(), job);
  const Shader shader(database, cells, mix, options.shading, options.samples * options.samples);
  if (options.spectral) {
    raster.band_edges_nm = database.bands().edges_nm;
    grow(raster.radiance, raster.n_pixels() * database.bands().size(), job);
  }
  const Renderer renderer(shader, options);
  tbb::parallel_for(tbb::blocked_range<int>(0, raster.height, 4), [&](const auto& rows) {
    for (int y = rows.begin(); y != rows.end(); ++y) {
      for (int x = 0; x < raster.width; ++x) {
        if (job.stopped()) return;
        const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) +
                        static_cast<std::size_t>(x);
        store(renderer.pixel(x, y), shader.channels(), at, raster);
      }
    }
  });
  job.check();
  return raster;
}

Vec3 scene_white(const LuminanceDatabase& database, const Mix& mix) {
  Vec3 white(0.0);
  for (std::size_t s = 0; s < mix.size(); ++s)
    white += mix[s] * database.sources()[s].flux_lm * source_xyz(database.sources()[s]);
  return white.y > 0.0 ? white / white.y : Vec3(1.0);
}

}  // namespace dim
