#pragma once

#include "sky/efficacy.hpp"
#include "sky/sky_model.hpp"

namespace dim {

/// Sky and sun of one moment, before the sky is scaled.
struct SkyAndSun {
  SkyModel model;
  Vec3 sun{0, 0, 1};  ///< unit vector to the sun, whether or not it shines
  double sky_horizontal_lx = 0.0;
  double direct_normal_lx = 0.0;  ///< of the sun's beam, on a surface facing it
  /// Where the model has the sun: as above, level where it is below the horizon.
  Vec3 model_sun() const;
};

/// What lights a building from outside at one moment.
struct Daylight {
  Sky sky;
  Vec3 sun{0, 0, 1};              ///< unit vector to the sun, whether or not it shines
  double direct_normal_lx = 0.0;  ///< of its beam, on a surface facing it
  /// Unobstructed, sky and sun together.
  double horizontal_lx() const {
    return sky.horizontal_lx() + (sun.z > 0.0 ? sun.z * direct_normal_lx : 0.0);
  }
};

/// The sky scaled, the sun as it is.
Daylight daylight_of(const SkyAndSun& light);

/// Irradiances that a Perez sky and its sun are made of.
struct Irradiance {
  double direct_normal_W_m2 = 0.0;
  double diffuse_horizontal_W_m2 = 0.0;
};

/// Sky of Perez et al. 1993 and sun, from irradiance by the efficacies of Perez et al. 1990. With the sun at
/// or below the horizon (twilight) there is no beam and the sky is that of a level sun. No diffuse light: a
/// black sky.
/// @param sun              unit vector to the sun
/// @param sun_distance_au  1 where no date is known
/// @param water_cm         precipitable water, see precipitable_water_cm
SkyAndSun perez_sky_and_sun(const Vec3& sun, const Irradiance& irradiance, double sun_distance_au = 1.0,
                            double water_cm = kUsualWater_cm);
Daylight perez_daylight(const Vec3& sun, const Irradiance& irradiance, double sun_distance_au = 1.0,
                        double water_cm = kUsualWater_cm);

}  // namespace dim
