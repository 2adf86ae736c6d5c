#include "climate/paper_method.hpp"

#include <algorithm>
#include <cmath>

#include "base/vec.hpp"

namespace dim {
namespace {

/// Below this altitude the sky's clearness is taken at it: Delta grows without bound towards the horizon.
constexpr double kLowestSun_deg = 3.0;
constexpr double kLargestDelta_W_m2 = 500.0;

}  // namespace

double overcast_efficacy_lm_W(double sun_altitude_deg, double global_W_m2) {
  const double phi = std::max(kLowestSun_deg, sun_altitude_deg);
  const double delta = std::min(kLargestDelta_W_m2, global_W_m2 / std::sin(radians(phi)));
  return (91.2 + 0.702 * phi - 0.0063 * phi * phi) * (1.22 - 7.96e-4 * delta + 7.96e-7 * delta * delta);
}

double beam_efficacy_lm_W(double sun_altitude_deg) {
  const double phi = sun_altitude_deg;
  return 17.72 +
         phi * (4.4585 + phi * (-8.7563e-2 + phi * (7.3948e-4 + phi * (-2.167e-6 + phi * -8.4132e-10))));
}

double cloud_cover(double diffuse_W_m2, double global_W_m2) {
  if (global_W_m2 <= 0.0) return 0.0;
  const double share = std::min(1.0, diffuse_W_m2 / global_W_m2);
  return share * share;
}

double paper_illuminance_lx(const PaperIrradiance& light, double daylight_factor, double sun_factor) {
  const double cover = cloud_cover(light.diffuse_W_m2, light.global_W_m2);
  const double sky =
      light.diffuse_W_m2 * ((1.0 - cover) * kClearSkyEfficacy_lm_W +
                            cover * overcast_efficacy_lm_W(light.sun_altitude_deg, light.global_W_m2));
  const double sun = light.sun_altitude_deg > 0.0
                         ? light.direct_normal_W_m2 * beam_efficacy_lm_W(light.sun_altitude_deg) * sun_factor
                         : 0.0;
  return sun + daylight_factor * sky;
}

}  // namespace dim
