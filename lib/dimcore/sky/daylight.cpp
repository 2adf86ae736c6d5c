#include "sky/daylight.hpp"

#include <algorithm>

#include "sky/direction.hpp"

namespace dim {

Vec3 SkyAndSun::model_sun() const {
  return sky_direction(std::max(0.0, altitude_rad(sun)), azimuth_rad(sun));
}

Daylight daylight_of(const SkyAndSun& light) {
  return {Sky(light.model, light.model_sun(), light.sky_horizontal_lx), light.sun, light.direct_normal_lx};
}

SkyAndSun perez_sky_and_sun(const Vec3& sun, const Irradiance& irradiance, double sun_distance_au,
                            double water_cm) {
  const double altitude = std::max(0.0, altitude_rad(sun));
  const double beam_W_m2 = sun.z > 0.0 ? irradiance.direct_normal_W_m2 : 0.0;
  // A black sky under the sun is the limit of a clear one.
  const double diffuse_W_m2 = std::max(1e-6, irradiance.diffuse_horizontal_W_m2);
  const SkyClearness state = sky_clearness(beam_W_m2, diffuse_W_m2, altitude, sun_distance_au);
  const double diffuse_lx =
      irradiance.diffuse_horizontal_W_m2 * diffuse_efficacy_lm_W(state, altitude, water_cm);
  return {SkyModel::perez(state, 0.5 * kPi - altitude), sun, std::max(0.0, diffuse_lx),
          beam_W_m2 * direct_efficacy_lm_W(state, altitude, water_cm)};
}

Daylight perez_daylight(const Vec3& sun, const Irradiance& irradiance, double sun_distance_au,
                        double water_cm) {
  return daylight_of(perez_sky_and_sun(sun, irradiance, sun_distance_au, water_cm));
}

}  // namespace dim
