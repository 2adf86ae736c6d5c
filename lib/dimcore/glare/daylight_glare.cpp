#include "glare/daylight_glare.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/fisheye.hpp"

namespace dim {
namespace {

constexpr double kLowLight_lx = 1000.0;

struct GlareArea {
  double light = 0.0, solid_angle_sr = 0.0;  // L omega, omega
  Vec3 towards{0.0};                         // by light

  double luminance_cd_m2() const { return light / solid_angle_sr; }
};

/// Glaring pixels in bins of the picture so small that all in one are of one source.
class Sources {
 public:
  Sources(std::span<const SeenPixel> pixels, const LineOfSight& sight) : sight_(sight) {
    for (const auto& pixel : pixels)
      if (pixel.luminance_cd_m2 >= kGlare_cd_m2) bins_[bin_of(pixel.towards)].push_back(&pixel);
  }

  std::vector<GlareArea> areas() {
    std::vector<const Pixels*> all;
    std::vector<Bin> places;
    for (const auto& [bin, pixels] : bins_) {
      places.push_back(bin);
      all.push_back(&pixels);
    }
    std::vector<std::size_t> parent(all.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
      while (parent[k] != k) k = parent[k] = parent[parent[k]];
      return k;
    };
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (may_touch(places[a], places[b]) && root(a) != root(b) && touch(*all[a], *all[b]))
          parent[std::max(root(a), root(b))] = std::min(root(a), root(b));
    std::map<std::size_t, GlareArea> by_root;
    for (std::size_t k = 0; k < all.size(); ++k) add(*all[k], by_root[root(k)]);
    std::vector<GlareArea> result;
    for (const auto& entry : by_root) result.push_back(entry.second);
    return result;
  }

 private:
  using Pixels = std::vector<const SeenPixel*>;
  using Bin = std::pair<int, int>;
  // In an equidistant picture lengths are at most pi/2 times those on the sphere: a bin's diagonal is below the radius.
  static constexpr double kBin_rad = 0.7 * kOneSource_rad;
  static constexpr int kReach = 3;  // bins: pi/2 * radius, and the bin itself

  Bin bin_of(const Vec3& towards) const {
    const Vec3 right = glm::cross(sight_.forward, sight_.up);
    const double x = glm::dot(towards, right), y = glm::dot(towards, sight_.up);
    const double across = std::hypot(x, y);
    const double angle = std::atan2(across, glm::dot(towards, sight_.forward));
    const double share = across > 0.0 ? angle / across / kBin_rad : 0.0;
    return {static_cast<int>(std::floor(x * share)), static_cast<int>(std::floor(y * share))};
  }

  static bool may_touch(const Bin& a, const Bin& b) {
    return std::abs(a.first - b.first) <= kReach && std::abs(a.second - b.second) <= kReach;
  }

  static bool touch(const Pixels& a, const Pixels& b) {
    const double near = std::cos(kOneSource_rad);
    for (const auto* p : a)
      for (const auto* q : b)
        if (glm::dot(p->towards, q->towards) >= near) return true;
    return false;
  }

  static void add(const Pixels& pixels, GlareArea& area) {
    for (const auto* pixel : pixels) {
      const double light = pixel->luminance_cd_m2 * pixel->solid_angle_sr;
      area.light += light;
      area.solid_angle_sr += pixel->solid_angle_sr;
      area.towards += light * pixel->towards;
    }
  }

  LineOfSight sight_;
  std::map<Bin, Pixels> bins_;
};

double low_light_share(double vertical_lx) {
  return vertical_lx < kLowLight_lx ? 1.0 / (1.0 + std::exp(4.0 - 0.024 * vertical_lx)) : 1.0;
}

}  // namespace

std::vector<SeenPixel> fisheye_pixels(const LineOfSight& sight, int side_px) {
  const Fisheye fisheye(Vec3(0.0), sight.forward, sight.up, FisheyeLaw::angular, side_px);
  std::vector<SeenPixel> pixels;
  for (int j = 0; j < side_px; ++j) {
    for (int i = 0; i < side_px; ++i) {
      if (const auto towards = fisheye.direction(i + 0.5, j + 0.5))
        pixels.push_back({*towards, fisheye.solid_angle_sr(i + 0.5, j + 0.5), 0.0});
    }
  }
  return pixels;
}

DaylightGlare daylight_glare(std::span<const SeenPixel> pixels, const LineOfSight& sight) {
  DaylightGlare glare;
  for (const auto& pixel : pixels)
    glare.vertical_lx += pixel.luminance_cd_m2 * pixel.solid_angle_sr * std::max(0.0, glm::dot(pixel.towards, sight.forward));
  double sum = 0.0;
  for (const auto& area : Sources(pixels, sight).areas()) {
    const double p = whole_view_position_index(area.towards, sight);
    sum += area.luminance_cd_m2() * area.luminance_cd_m2() * area.solid_angle_sr / (p * p);
    ++glare.n_sources;
  }
  const double ev = glare.vertical_lx;
  const double of_sources = ev > 0.0 ? std::log10(1.0 + sum / std::pow(ev, 1.87)) : 0.0;
  glare.dgp = std::min(1.0, low_light_share(ev) * (5.87e-5 * ev + 0.0918 * of_sources + 0.16));
  glare.dgps = std::min(1.0, 6.22e-5 * ev + 0.184);
  return glare;
}

}  // namespace dim
