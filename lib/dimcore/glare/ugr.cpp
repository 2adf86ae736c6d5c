#include "glare/ugr.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {

GlareSource glare_source(const Vec3& towards, double intensity_cd, double projected_area_m2,
                         double distance_m) {
  const double area_m2 = std::max(projected_area_m2, kSmallSource_m2);
  return {towards, intensity_cd / area_m2, area_m2 / (distance_m * distance_m)};
}

UnifiedGlareRating unified_glare_rating(std::span<const GlareSource> sources, double background_cd_m2,
                                        const LineOfSight& sight) {
  UnifiedGlareRating rating;
  rating.background_cd_m2 = background_cd_m2;
  double sum = 0.0;
  for (const auto& source : sources) {
    const double p = position_index(source.towards, sight);
    if (!std::isfinite(p) || !(source.luminance_cd_m2 > 0.0)) continue;
    sum += source.luminance_cd_m2 * source.luminance_cd_m2 * source.solid_angle_sr / (p * p);
    ++rating.n_sources;
    rating.n_large += source.solid_angle_sr > kLargestUgr_sr;
  }
  rating.ugr = sum > 0.0 && background_cd_m2 > 0.0 ? 8.0 * std::log10(0.25 / background_cd_m2 * sum)
                                                   : std::numeric_limits<double>::quiet_NaN();
  return rating;
}

}  // namespace dim
