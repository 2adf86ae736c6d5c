#pragma once

namespace dim {

/// Extraterrestrial normal irradiance at the mean distance of the sun, W/m2.
inline constexpr double kSolarConstant_W_m2 = 1367.0;
/// Precipitable water where no dew point is known, cm.
inline constexpr double kUsualWater_cm = 2.0;

/// What Perez et al. 1990 describe a sky by.
struct SkyClearness {
  double clearness = 1.0;   ///< epsilon, 1 (overcast) .. 12
  double brightness = 0.2;  ///< Delta, 0.01 .. 0.6
};

/// Perez et al. 1990, eqs 1 and 2; kept within 1..12 and 0.01..0.6.
/// @param direct_normal_W_m2       >= 0
/// @param diffuse_horizontal_W_m2  > 0
/// @param sun_altitude_rad         0..pi/2
/// @param sun_distance_au          1 where no date is known
SkyClearness sky_clearness(double direct_normal_W_m2, double diffuse_horizontal_W_m2, double sun_altitude_rad,
                           double sun_distance_au = 1.0);

/// Bin of the clearness, 0..7, limits 1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2.
int clearness_bin(double clearness);

/// Relative optical air mass (Kasten 1966), 1 at the zenith, 37 at the horizon.
double air_mass(double sun_altitude_rad);

/// Water in the air above, cm, from the dew point (Perez et al. 1990, eq. 3).
double precipitable_water_cm(double dew_point_C);

/// Luminous efficacy of light of the sky on a level surface, lm/W, > 0 (Perez et al. 1990, eq. 7).
double diffuse_efficacy_lm_W(const SkyClearness& state, double sun_altitude_rad,
                             double water_cm = kUsualWater_cm);

/// Luminous efficacy of the sun's beam, lm/W, >= 0 (Perez et al. 1990, eq. 8).
double direct_efficacy_lm_W(const SkyClearness& state, double sun_altitude_rad,
                            double water_cm = kUsualWater_cm);

}  // namespace dim
