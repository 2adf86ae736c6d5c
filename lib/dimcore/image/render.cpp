#include "image/render.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/low_discrepancy.hpp"
#include "base/meter.hpp"
#include "image/edge_mask.hpp"
#include "image/lens.hpp"
#include "scene/joints.hpp"

namespace dim {
namespace {

constexpr int kTile_px = 16;

struct Pixel {
  Light light;
  double scalar = 0.0;
  int n_scalar = 0;
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

Vec2 on_plane(const Frame& frame, const Sight& sight) {
  const double t = -frame.height(sight.origin) / glm::dot(sight.direction, frame.n);
  return frame.to_local(sight.origin + t * sight.direction);
}

/// What one part of a picture shows. Rays that meet plain surfaces are gathered into places, so that the light on
/// each surface is found for all of the tile together.
class Tile {
 public:
  Tile(const Shader& shader, const RenderOptions& options, const Lens& lens, const EdgeMask& edges)
      : shader_(shader), options_(options), lens_(lens), edges_(edges) {}

  void draw(int x0, int y0, Raster& raster) {
    const int x1 = std::min(x0 + kTile_px, raster.width), y1 = std::min(y0 + kTile_px, raster.height);
    pixels_.assign(static_cast<std::size_t>((x1 - x0) * (y1 - y0)), {});
    spots_.clear();
    std::uint32_t at = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        pixels_[at].light.assign(shader_.channels().size(), 0.0);
        look(x, y, at++);
      }
    shade_spots();
    at = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        store(pixels_[at++], shader_.channels(),
              static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x),
              raster);
  }

 private:
  // Rays of one pixel that met one surface, in one cell where these are flat.
  struct Spot {
    std::uint32_t pixel = 0;
    int surface = 0;
    int n_rays = 0;
    LitPlace place;
  };

  void look(int x, int y, std::uint32_t at) {
    const int n = options_.samples;
    if (n > 1 && !edges_.at(x, y) && look_once(x, y, at)) return;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const auto sight = lens_.sight(x + (i + 0.5) / n, y + (j + 0.5) / n);
        if (!sight) continue;
        const Hit hit = shader_.first(sight->origin, sight->direction);
        if (shader_.kind(hit) == Shader::Kind::place)
          add_spot(at, hit, x, y);
        else
          see(at, *sight, hit, 1.0 / (n * n), chance(x * n + i, y * n + j), 1);
      }
  }

  // A pixel in which nothing begins or ends.
  bool look_once(int x, int y, std::uint32_t at) {
    const auto sight = lens_.sight(x + 0.5, y + 0.5);
    if (!sight) return true;
    const Hit hit = shader_.first(sight->origin, sight->direction);
    const auto kind = shader_.kind(hit);
    const int n_all = options_.samples * options_.samples;
    if (kind == Shader::Kind::mirror) return false;
    if (kind != Shader::Kind::place) {
      see(at, *sight, hit, 1.0, chance(x, y), n_all);
      return true;
    }
    const Frame& frame = shader_.outlines()[static_cast<std::size_t>(hit.plate)]->frame();
    std::array<Vec2, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto corner = lens_.sight(x + (k == 1 || k == 2), y + (k >= 2));
      if (!corner) return false;
      corners[k] = on_plane(frame, *corner);
    }
    if (!shader_.in_one_cell(static_cast<std::size_t>(hit.plate), corners)) return false;
    if (signed_area({corners.begin(), corners.end()}) < 0.0) std::reverse(corners.begin(), corners.end());
    spots_.push_back({at, hit.plate, n_all, {hit.local, corners, true, 1.0, chance(x, y)}});
    return true;
  }

  void add_spot(std::uint32_t at, const Hit& hit, int x, int y) {
    const auto same = [&](const Spot& spot) {
      return spot.surface == hit.plate &&
             (options_.shading != Shading::cell ||
              shader_.in_one_cell(static_cast<std::size_t>(hit.plate),
                                  {spot.place.local, hit.local, hit.local, hit.local}));
    };
    for (std::size_t k = spots_.size(); k-- > 0 && spots_[k].pixel == at;) {
      if (!same(spots_[k])) continue;
      ++spots_[k].n_rays;
      return;
    }
    spots_.push_back({at, hit.plate, 1, {hit.local, {}, false, 1.0, chance(x, y)}});
  }

  void see(std::uint32_t at, const Sight& sight, const Hit& hit, double weight, std::uint64_t chance, int n_rays) {
    Pixel& pixel = pixels_[at];
    seen_.assign(shader_.channels().size(), 0.0);
    const auto seen = shader_.seen(sight.origin, sight.direction, hit, weight, chance, seen_);
    add(pixel, seen_, n_rays, seen.anything, seen.surface, seen.illuminance_lx);
  }

  void add(Pixel& pixel, const Light& light, int n_rays, bool anything, bool surface, double illuminance_lx) const {
    const double share = static_cast<double>(n_rays) / (options_.samples * options_.samples);
    for (std::size_t c = 0; c < light.size(); ++c) pixel.light[c] += share * light[c];
    const bool luminance = options_.scalar == ScalarQuantity::luminance;
    if (luminance ? !anything : !surface) return;
    pixel.scalar += n_rays * (luminance ? luminance_cd_m2(light) : illuminance_lx);
    pixel.n_scalar += n_rays;
  }

  double luminance_cd_m2(const Light& light) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < light.size(); ++c) sum += shader_.channels().xyz(c).y * light[c];
    return sum;
  }

  void shade_spots() {
    std::stable_sort(spots_.begin(), spots_.end(),
                     [](const Spot& a, const Spot& b) { return a.surface < b.surface; });
    for (std::size_t first = 0, last = 0; first < spots_.size(); first = last) {
      while (last < spots_.size() && spots_[last].surface == spots_[first].surface) ++last;
      shade({spots_.data() + first, last - first});
    }
  }

  void shade(std::span<Spot> spots) {
    const auto surface = static_cast<std::size_t>(spots.front().surface);
    places_.clear();
    open_.assign(spots.size(), -1);
    for (std::size_t k = 0; k < spots.size(); ++k) {
      Spot& spot = spots[k];
      spot.place.weight = static_cast<double>(spot.n_rays) / (options_.samples * options_.samples);
      if (!shader_.wants_direct(surface, spot.place.local)) continue;
      open_[k] = static_cast<std::ptrdiff_t>(places_.size());
      places_.push_back(spot.place);
    }
    if (!places_.empty()) shader_.place_light().find(surface, places_, lamp_lx_);
    const auto n_lamps = static_cast<std::ptrdiff_t>(places_.empty() ? 0 : lamp_lx_.size() / places_.size());
    for (std::size_t k = 0; k < spots.size(); ++k) {
      seen_.assign(shader_.channels().size(), 0.0);
      const double lux = shader_.shade(surface, spots[k].place.local,
                                       open_[k] < 0 ? nullptr : lamp_lx_.data() + open_[k] * n_lamps, seen_);
      add(pixels_[spots[k].pixel], seen_, spots[k].n_rays, true, true, lux);
    }
  }

  static std::uint64_t chance(int x, int y) {
    return mix(static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x));
  }

  const Shader& shader_;
  const RenderOptions& options_;
  const Lens& lens_;
  const EdgeMask& edges_;
  std::vector<Pixel> pixels_;
  std::vector<Spot> spots_;
  std::vector<LitPlace> places_;
  std::vector<std::ptrdiff_t> open_;  // place of a spot, -1: none
  std::vector<double> lamp_lx_;
  Light seen_;
};

EdgeMask edges_in(const Lens& lens, const View& view, const Shader& shader, const Zone& zone, const Job& job) {
  const double near_m = 1e-6 * zone.diameter_m;
  EdgeMask mask(view.width, view.height);
  lens.mark_rim(mask);
  for (const auto* polygon : shader.outlines()) {
    job.check();
    for (const auto& ring : polygon->corners())
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) lens.mark_edge(ring[j], ring[i], near_m, mask);
  }
  const auto joints = find_joints(zone);
  for (std::size_t s = 0; s < joints.size(); ++s) {
    const Frame& frame = zone.surfaces[s].polygon.frame();
    for (const auto& joint : joints[s]) lens.mark_edge(frame.to_world(joint.a), frame.to_world(joint.b), near_m, mask);
  }
  return mask;
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

void check_picture_fits(const RenderOptions& options, std::size_t n_bands, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  constexpr double kPerPixel = 48.0;  // colours, figures, tone and the file's bytes
  const double needed = (kPerPixel + static_cast<double>(options.spectral ? n_bands : 0) * sizeof(float)) *
                        options.view.width * options.view.height;
  if (needed <= static_cast<double>(job.memory_limit_bytes)) return;
  throw LimitError(fmt::format("a picture of {} x {} pixels needs {:.2f} GiB, {:.2f} GiB are free; use a smaller --size",
                               options.view.width, options.view.height, needed / kGiB,
                               static_cast<double>(job.memory_limit_bytes) / kGiB));
}

}  // namespace

Raster render_view(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                   const RenderOptions& options, const Job& job) {
  check_picture_fits(options, database.bands().size(), job);
  Raster raster;
  raster.width = options.view.width;
  raster.height = options.view.height;
  raster.scalar_unit = options.scalar == ScalarQuantity::illuminance ? "lx" : "cd/m²";
  grow(raster.xyz, raster.n_pixels() * 3, job);
  grow(raster.scalar, raster.n_pixels(), job);
  const Shader shader(database, cells, mix, options.shading);
  if (options.spectral) {
    raster.band_edges_nm = database.bands().edges_nm;
    grow(raster.radiance, raster.n_pixels() * database.bands().size(), job);
  }
  const Lens lens(options.view);
  const EdgeMask edges = edges_in(lens, options.view, shader, database.zone(), job);
  const int n_across = (raster.width - 1) / kTile_px + 1, n_down = (raster.height - 1) / kTile_px + 1;
  Meter meter(job, "draw", static_cast<std::size_t>(n_across) * static_cast<std::size_t>(n_down));
  tbb::parallel_for(tbb::blocked_range2d<int>(0, n_down, 1, 0, n_across, 4), [&](const auto& tiles) {
    Tile tile(shader, options, lens, edges);
    for (int j = tiles.rows().begin(); j != tiles.rows().end(); ++j) {
      for (int i = tiles.cols().begin(); i != tiles.cols().end(); ++i) {
        if (job.stopped()) return;
        tile.draw(i * kTile_px, j * kTile_px, raster);
        meter.add(1);
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
