#include "sky/efficacy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.hpp"

namespace dim {
namespace {

struct Coefficients {
  double a, b, c, d;
};

// Perez et al. 1990 ("Modeling daylight availability and irradiance components from direct and global
// irradiance", Solar Energy 44), table 4, as in Radiance's gendaylit.
constexpr std::array<Coefficients, 8> kDiffuse = {{{97.24, -0.46, 12.00, -8.91},
                                                   {107.22, 1.15, 0.59, -3.95},
                                                   {104.97, 2.96, -5.53, -8.77},
                                                   {102.39, 5.59, -13.95, -13.90},
                                                   {100.71, 5.94, -22.75, -23.74},
                                                   {106.42, 3.83, -36.15, -28.83},
                                                   {141.88, 1.90, -53.24, -14.03},
                                                   {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<Coefficients, 8> kDirect = {{{57.20, -4.55, -2.98, 117.12},
                                                  {98.99, -3.46, -1.21, 12.38},
                                                  {109.83, -4.90, -1.71, -8.81},
                                                  {110.34, -5.84, -1.99, -4.56},
                                                  {106.36, -3.97, -1.75, -6.16},
                                                  {107.19, -1.25, -1.51, -26.73},
                                                  {105.75, 0.77, -1.26, -34.44},
                                                  {101.18, 1.58, -1.10, -8.29}}};

}  // namespace

int clearness_bin(double clearness) {
  constexpr std::array<double, 7> kLimits = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
  return static_cast<int>(std::upper_bound(kLimits.begin(), kLimits.end(), clearness) - kLimits.begin());
}

double air_mass(double sun_altitude_rad) {
  const double altitude_deg = std::max(0.0, degrees(sun_altitude_rad));
  return 1.0 / (std::sin(radians(altitude_deg)) + 0.15 * std::pow(altitude_deg + 3.885, -1.253));
}

SkyClearness sky_clearness(double direct_normal_W_m2, double diffuse_horizontal_W_m2, double sun_altitude_rad,
                           double sun_distance_au) {
  const double zenith = 0.5 * kPi - sun_altitude_rad;
  const double bend = 1.041 * zenith * zenith * zenith;
  const double ratio = direct_normal_W_m2 / diffuse_horizontal_W_m2;
  const double outside = kSolarConstant_W_m2 / (sun_distance_au * sun_distance_au);
  return {std::clamp((1.0 + ratio + bend) / (1.0 + bend), 1.0, 12.0),
          std::clamp(diffuse_horizontal_W_m2 * air_mass(sun_altitude_rad) / outside, 0.01, 0.6)};
}

double precipitable_water_cm(double dew_point_C) { return std::exp(0.07 * dew_point_C - 0.075); }

double diffuse_efficacy_lm_W(const SkyClearness& state, double sun_altitude_rad, double water_cm) {
  const auto& k = kDiffuse[static_cast<std::size_t>(clearness_bin(state.clearness))];
  return k.a + k.b * water_cm + k.c * std::sin(sun_altitude_rad) + k.d * std::log(state.brightness);
}

double direct_efficacy_lm_W(const SkyClearness& state, double sun_altitude_rad, double water_cm) {
  const auto& k = kDirect[static_cast<std::size_t>(clearness_bin(state.clearness))];
  const double zenith = 0.5 * kPi - sun_altitude_rad;
  return std::max(0.0, k.a + k.b * water_cm + k.c * std::exp(5.73 * zenith - 5.0) + k.d * state.brightness);
}

}  // namespace dim
