#pragma once

#include <span>
#include <vector>

#include "climate/annual.hpp"

namespace dim {

/// Which steps count for the metrics of a year.
struct MetricTimes {
  std::vector<bool> occupied;  ///< [n_steps]
  std::vector<std::size_t>
      daylight;  ///< steps of the 4,380 hours with the brightest sky (EN 17037), ascending
  double step_h = 1.0;
};

/// The half of the year with the most diffuse light on an unobstructed level surface.
std::vector<std::size_t> daylight_steps(const AnnualSky& sky);

/// A year of daylight at one point.
struct PointMetrics {
  double autonomy = 0.0;              ///< DA: share of occupied time at or above the target
  double continuous_autonomy = 0.0;   ///< cDA: the same, time below the target counting in part
  double useful_low = 0.0;            ///< UDI: shares of occupied time below 100 lx,
  double useful_supplementary = 0.0;  ///< 100 to 300 lx,
  double useful_autonomous = 0.0;     ///< 300 to 3,000 lx,
  double useful_high = 0.0;           ///< and above
  double exposure_lx_h = 0.0;         ///< over the whole year
  double half_daylight_lx = 0.0;      ///< reached for half of the daylight hours (EN 17037, method 2)
  double direct_sun_h = 0.0;          ///< occupied hours with more than 1,000 lx of direct sun (for ASE)
};

/// @param total_lx       [n_steps] sky and sun
/// @param direct_sun_lx  [n_steps]
/// @param target_lx      of autonomy, > 0
PointMetrics point_metrics(std::span<const float> total_lx, std::span<const float> direct_sun_lx,
                           const MetricTimes& times, double target_lx);

/// The points of a block, in parallel. [block.n_points]
std::vector<PointMetrics> block_metrics(const PointBlock& block, const MetricTimes& times, double target_lx);

/// Daylight factors under the traditional overcast sky, 0..1. [n_points]
std::vector<double> daylight_factors(const DaylightCoefficients& coefficients);

/// Hours on a day, every five minutes looked at, in which the sun would shine on each point in a clear sky:
/// exposure to sunlight of EN 17037, without its least altitude of the sun. [n_points]
std::vector<double> sunlight_hours(const Weather& weather, const LocalTime& day, const SunFactors& sun,
                                   std::size_t n_points);

/// A level of daylight provision of EN 17037, table A.1.
enum class Provision { none, minimum, medium, high };
const char* word_of(Provision level);

/// A year of daylight on a plane, every point standing for the same area.
struct PlaneMetrics {
  std::size_t n_points = 0;
  PointMetrics mean;
  double spatial_autonomy = 0.0;  ///< sDA: share of points with the target for half of the occupied time
  double sun_exposure = 0.0;      ///< ASE: share of points with over 250 occupied hours of direct sun
  double target_lx = 0.0;         ///< on half of the area for half of the daylight hours
  double minimum_lx = 0.0;        ///< on 95 % of it
  Provision provision = Provision::none;
};
PlaneMetrics plane_metrics(std::span<const PointMetrics> points);

/// Level for the illuminances reached on half and on 95 % of an area (targets 300, 500, 750 lx; minima 100,
/// 300, 500 lx).
Provision provision_of(double target_lx, double minimum_lx);

}  // namespace dim
