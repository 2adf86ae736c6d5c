#pragma once

#include <span>

#include "glare/position_index.hpp"

namespace dim {

/// Between these solid angles the UGR formula was made to hold (CIE 117).
inline constexpr double kSmallestUgr_sr = 3e-4, kLargestUgr_sr = 0.1;

/// Sources of less projected area are taken as if they had this one, their intensity kept: L^2 omega becomes
/// 200 I^2 / r^2 (CIE 147:2002, small sources).
inline constexpr double kSmallSource_m2 = 0.005;

/// A luminaire as an eye sees it.
struct GlareSource {
  Vec3 towards{1, 0, 0};         ///< from the eye
  double luminance_cd_m2 = 0.0;  ///< intensity over projected luminous area
  double solid_angle_sr = 0.0;   ///< projected luminous area over distance squared
};

/// The source that sends an intensity from a projected area at a distance, small ones as CIE 147 has them.
/// @param distance_m  > 0
GlareSource glare_source(const Vec3& towards, double intensity_cd, double projected_area_m2,
                         double distance_m);

struct UnifiedGlareRating {
  double ugr = 0.0;  ///< NaN where no source counts, or there is no background to see it against
  double background_cd_m2 = 0.0;
  int n_sources = 0;  ///< that count
  int n_large = 0;    ///< of them larger than kLargestUgr_sr: UGR underrates what they do
};

/// CIE 117: UGR = 8 log10(0.25 / L_b * sum of L^2 omega / p^2).
/// @param background_cd_m2  vertical illuminance at the eye by all but the sources themselves, over pi
UnifiedGlareRating unified_glare_rating(std::span<const GlareSource> sources, double background_cd_m2,
                                        const LineOfSight& sight);

}  // namespace dim
