#pragma once

namespace dim {

/// Equations (21) to (24) of the paper: a sensor's illuminance from irradiance, luminous efficacies, its
/// daylight factor and what it sees of the sun. Corrections to the print are stated in docs/esp-r.md.

/// Efficacy of a clear sky, lm/W.
inline constexpr double kClearSkyEfficacy_lm_W = 144.0;

/// Efficacy of an overcast sky, lm/W (21). @param global_W_m2  unobstructed horizontal irradiance
double overcast_efficacy_lm_W(double sun_altitude_deg, double global_W_m2);

/// Efficacy of the sun's beam, lm/W. @param sun_altitude_deg  0..90
double beam_efficacy_lm_W(double sun_altitude_deg);

/// Share of the sky that counts as overcast: (diffuse / global)^2, 0 without light.
double cloud_cover(double diffuse_W_m2, double global_W_m2);

/// One moment's irradiance.
struct PaperIrradiance {
  double sun_altitude_deg = 0.0;
  double direct_normal_W_m2 = 0.0;
  double diffuse_W_m2 = 0.0;  ///< on the horizontal
  double global_W_m2 = 0.0;   ///< on the horizontal
};

/// Illuminance of a sensor, lx (24): I_dn K_d F + df I_fh [(1 - C) K_cs + C K_os].
/// @param daylight_factor  of the overcast sky, 0..1
/// @param sun_factor       illuminance by the sun's beam per lx of it on a surface facing it: visibility,
/// cosine and
///                         transmittance
double paper_illuminance_lx(const PaperIrradiance& light, double daylight_factor, double sun_factor);

}  // namespace dim
