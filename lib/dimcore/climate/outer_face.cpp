#include "climate/outer_face.hpp"

#include <algorithm>
#include <cmath>

#include "base/low_discrepancy.hpp"
#include "light/outside_light.hpp"
#include "sky/direction.hpp"

namespace dim {
namespace {

constexpr std::uint64_t kSkyRays = 1 << 13, kSunRays = 64;

}  // namespace

OuterFace::OuterFace(const Zone& zone, const std::string& group, int subdivision)
    : north_rad_(zone.site ? radians(zone.site->north_deg) : 0.0),
      obstructions_(zone, Lights{}),
      windows_(find_windows(zone)) {
  const OutsideLight light(SkyPatches(subdivision), north_rad_);
  column_lx_.assign(light.n_columns(), 0.0);
  for (std::size_t w = 0; w < windows_.windows.size(); ++w) {
    if (windows_.groups[windows_.windows[w].group].name != group) continue;
    members_.push_back(w);
    area_m2_ += windows_.windows[w].polygon.area_m2();
  }
  for (const std::size_t w : members_) {
    const Window& window = windows_.windows[w];
    const double lx = kPi * window.polygon.area_m2() / (area_m2_ * static_cast<double>(kSkyRays));
    const LowDiscrepancy4 points(w);
    for (std::uint64_t i = 0; i < kSkyRays; ++i) {
      const auto x = points(i);
      const double radius = std::sqrt(x[0]), turn = 2.0 * kPi * x[1];
      const Vec3 outwards = -window.frame().direction_to_world(
          {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1.0 - x[0])});
      const Vec3 on_glass = window.frame().to_world(window.area.point(x[2], x[3]));
      if (!window.open_outside && obstructions_.caster().nearest(on_glass, outwards, window.plate).plate >= 0) continue;
      light.open(outwards).each_column([&](std::size_t c, double cd_m2) { column_lx_[c] += lx * cd_m2; });
    }
  }
}

double OuterFace::sun_factor(const Vec3& towards) const {
  const Vec3 sun = to_zone(towards, north_rad_);
  double sum = 0.0;
  for (const std::size_t w : members_) {
    const Window& window = windows_.windows[w];
    const double cosine = -glm::dot(window.frame().n, sun);
    if (!(cosine > 0.0)) continue;
    const LowDiscrepancy4 points(w);
    std::uint64_t seen = 0;
    for (std::uint64_t i = 0; i < kSunRays && !window.open_outside; ++i) {
      const auto x = points(i);
      const Vec3 on_glass = window.frame().to_world(window.area.point(x[2], x[3]));
      seen += obstructions_.caster().nearest(on_glass, sun, window.plate).plate < 0;
    }
    const double share = window.open_outside ? 1.0 : static_cast<double>(seen) / static_cast<double>(kSunRays);
    sum += share * cosine * window.polygon.area_m2() / area_m2_;
  }
  return sum;
}

}  // namespace dim
