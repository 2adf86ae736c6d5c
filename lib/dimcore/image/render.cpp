#include "image/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/perspective.hpp"
#include "image/cell_shade.hpp"

namespace dim {
namespace {

constexpr int kRoundCorners = 48;

// Outline of a luminous opening in space, empty where it has no area.
Ring3 outline(const ShownLuminaire& luminaire) {
  const auto at = [&](double x, double y) { return luminaire.at + x * luminaire.c0 + y * luminaire.c90; };
  const double a = luminaire.opening.length_m / 2.0, b = luminaire.opening.width_m / 2.0;
  if (!(area_m2(luminaire.opening) > 0.0) || !(a > 0.0) || !(b > 0.0)) return {};
  const auto shape = luminaire.opening.shape;
  if (shape == OpeningShape::kEllipse || shape == OpeningShape::kVerticalCylinder ||
      shape == OpeningShape::kEllipsoid) {
    // Corners a little outside, so that the area, and with it the light shown, is that of the round shape.
    const double turn = 2.0 * kPi / kRoundCorners, swell = std::sqrt(turn / std::sin(turn));
    Ring3 ring;
    for (int i = 0; i < kRoundCorners; ++i) {
      ring.push_back(at(swell * a * std::cos(i * turn), swell * b * std::sin(i * turn)));
    }
    return ring;
  }
  return {at(-a, -b), at(a, -b), at(a, b), at(-a, b)};
}

// The openings that can be seen, with the luminance each shows.
class Openings {
 public:
  Openings(const LuminanceDatabase& database, const Mix& mix) : database_(database), mix_(mix) {
    for (const auto& luminaire : database.luminaires()) {
      const Ring3 ring = outline(luminaire);
      if (ring.empty()) continue;
      polygons_.emplace_back(ring);
      shown_.push_back(&luminaire);
    }
  }

  const std::vector<Polygon>& polygons() const { return polygons_; }

  /// XYZ of opening `i` seen along the unit direction `ray`.
  Vec3 xyz(std::size_t i, const Vec3& ray) const {
    const auto& luminaire = *shown_[i];
    const double cosine = -glm::dot(ray, luminaire.aim);
    const auto& mean_cd = database_.photometry()[luminaire.photometry];
    const double gamma_deg = degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
    const auto below = std::min(static_cast<std::size_t>(gamma_deg), mean_cd.size() - 2);
    const double t = gamma_deg - static_cast<double>(below);
    const double cd = mean_cd[below] + t * (mean_cd[below + 1] - mean_cd[below]);
    // Towards grazing both intensity and projected area vanish; their quotient is not to.
    const double projected_m2 = area_m2(luminaire.opening) * std::max(std::abs(cosine), 0.02);
    const double luminance = mix_[luminaire.source] * luminaire.factor * cd / projected_m2;
    return luminance * source_xyz(database_.sources()[luminaire.source]);
  }

 private:
  const LuminanceDatabase& database_;
  const Mix& mix_;
  std::vector<Polygon> polygons_;
  std::vector<const ShownLuminaire*> shown_;
};

struct Pixel {
  Vec3 xyz{0.0};
  double scalar = 0.0;
  int n_scalar = 0;
};

class Renderer {
 public:
  Renderer(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
           const RenderOptions& options)
      : zone_(database.zone()),
        options_(options),
        shade_(database.zone(), cells, cell_appearance(database, cells, mix), options.smooth),
        openings_(database, mix),
        caster_(plates(), database.zone().diameter_m),
        perspective_({options.view.eye, options.view.focus, options.view.up, options.view.fov_rad,
                      options.view.width, options.view.height}) {}

  Pixel pixel(int x, int y) const {
    Pixel sum;
    const int n = options_.samples;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) add(sum, x + (i + 0.5) / n, y + (j + 0.5) / n);
    }
    sum.xyz /= static_cast<double>(n * n);
    return sum;
  }

 private:
  std::vector<Plate> plates() const {
    auto result = plates_of(zone_);
    for (const auto& polygon : openings_.polygons()) result.push_back({&polygon});
    return result;
  }

  void add(Pixel& sum, double px, double py) const {
    const Vec3 ray = perspective_.direction(px, py);
    const Hit hit = caster_.nearest(options_.view.eye, ray);
    if (hit.plate < 0) return;
    const auto plate = static_cast<std::size_t>(hit.plate);
    Vec3 xyz(0.0);
    double scalar = std::numeric_limits<double>::quiet_NaN();
    if (plate >= zone_.surfaces.size()) {
      xyz = openings_.xyz(plate - zone_.surfaces.size(), ray);
    } else if (!hit.back && !zone_.surfaces[plate].outside) {
      const auto seen = shade_.at(plate, hit.local);
      xyz = seen.xyz_cd_m2;
      scalar = seen.illuminance_lx;
    }
    sum.xyz += xyz;
    if (options_.scalar == ScalarQuantity::luminance) scalar = xyz.y;
    if (std::isnan(scalar)) return;
    sum.scalar += scalar;
    ++sum.n_scalar;
  }

  const Zone& zone_;
  const RenderOptions& options_;
  CellShade shade_;
  Openings openings_;
  RayCaster caster_;
  Perspective perspective_;
};

}  // namespace

Raster render_view(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                   const RenderOptions& options, const Job& job) {
  Raster raster;
  raster.width = options.view.width;
  raster.height = options.view.height;
  raster.scalar_unit = options.scalar == ScalarQuantity::illuminance ? "lx" : "cd/m²";
  raster.xyz.resize(raster.n_pixels() * 3);
  raster.scalar.resize(raster.n_pixels());
  const Renderer renderer(database, cells, mix, options);
  tbb::parallel_for(tbb::blocked_range<int>(0, raster.height, 4), [&](const auto& rows) {
    for (int y = rows.begin(); y != rows.end(); ++y) {
      for (int x = 0; x < raster.width; ++x) {
        if (job.stopped()) return;
        const Pixel pixel = renderer.pixel(x, y);
        const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) +
                        static_cast<std::size_t>(x);
        for (int axis = 0; axis < 3; ++axis)
          raster.xyz[at * 3 + static_cast<std::size_t>(axis)] = static_cast<float>(pixel.xyz[axis]);
        raster.scalar[at] = pixel.n_scalar > 0 ? static_cast<float>(pixel.scalar / pixel.n_scalar)
                                               : std::numeric_limits<float>::quiet_NaN();
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
