#include "climate/metrics.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sky/weather_light.hpp"

namespace dim {
namespace {

constexpr double kDaylightHours = 4380.0;
constexpr double kSunlit_lx = 1000.0;
constexpr double kMostSun_h = 250.0;

/// The value that a share of all values reach or exceed: the n-th largest, n the share of their number
/// rounded up.
double reached_by(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto n = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()) - 1e-9));
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(n, 1, values.size()) - 1);
  std::nth_element(values.begin(), at, values.end(), std::greater<>());
  return *at;
}

}  // namespace

std::vector<std::size_t> daylight_steps(const AnnualSky& sky) {
  std::vector<std::size_t> steps(sky.n_steps);
  std::iota(steps.begin(), steps.end(), std::size_t{0});
  const auto n = std::min(sky.n_steps, static_cast<std::size_t>(std::lround(kDaylightHours / sky.step_h)));
  // Ties at night go by time, so that the choice is always the same.
  std::stable_sort(steps.begin(), steps.end(), [&](std::size_t a, std::size_t b) {
    return sky.sky_horizontal_lx[a] > sky.sky_horizontal_lx[b];
  });
  steps.resize(n);
  std::sort(steps.begin(), steps.end());
  return steps;
}

PointMetrics point_metrics(std::span<const float> total_lx, std::span<const float> direct_sun_lx,
                           const MetricTimes& times, double target_lx) {
  PointMetrics m;
  double n_occupied = 0.0;
  for (std::size_t i = 0; i < total_lx.size(); ++i) {
    const double lx = static_cast<double>(total_lx[i]);
    m.exposure_lx_h += lx * times.step_h;
    if (!times.occupied[i]) continue;
    n_occupied += 1.0;
    m.autonomy += lx >= target_lx;
    m.continuous_autonomy += std::min(1.0, lx / target_lx);
    m.useful_low += lx < 100.0;
    m.useful_supplementary += lx >= 100.0 && lx < 300.0;
    m.useful_autonomous += lx >= 300.0 && lx <= 3000.0;
    m.useful_high += lx > 3000.0;
    m.direct_sun_h += static_cast<double>(direct_sun_lx[i]) > kSunlit_lx ? times.step_h : 0.0;
  }
  if (n_occupied > 0.0) {
    for (double* share : {&m.autonomy, &m.continuous_autonomy, &m.useful_low, &m.useful_supplementary,
                          &m.useful_autonomous, &m.useful_high})
      *share /= n_occupied;
  }
  std::vector<double> by_day(times.daylight.size());
  std::transform(times.daylight.begin(), times.daylight.end(), by_day.begin(),
                 [&](std::size_t i) { return static_cast<double>(total_lx[i]); });
  m.half_daylight_lx = reached_by(std::move(by_day), 0.5);
  return m;
}

std::vector<PointMetrics> block_metrics(const PointBlock& block, const MetricTimes& times, double target_lx) {
  std::vector<PointMetrics> metrics(block.n_points);
  tbb::parallel_for(std::size_t{0}, block.n_points, [&](std::size_t p) {
    std::vector<float> total(block.n_steps);
    const auto sky = block.sky(p), sun = block.sun(p);
    std::transform(sky.begin(), sky.end(), sun.begin(), total.begin(), std::plus<>());
    metrics[p] = point_metrics(total, block.direct_sun(p), times, target_lx);
  });
  return metrics;
}

std::vector<double> daylight_factors(const DaylightCoefficients& coefficients) {
  constexpr double kHorizontal_lx = 10000.0;
  const auto sky = sky_of_moment({SkyModel::overcast(), {0, 0, 1}, kHorizontal_lx, 0.0},
                                 coefficients.subdivision, coefficients.ground_reflectance);
  std::vector<double> factors;
  annual_illuminance(sky, coefficients, {}, [&](const PointBlock& block) {
    for (const float lx : block.sky_lx) factors.push_back(static_cast<double>(lx) / kHorizontal_lx);
  });
  return factors;
}

std::vector<double> sunlight_hours(const Weather& weather, const LocalTime& day, const SunFactors& sun,
                                   std::size_t n_points) {
  constexpr double kStep_h = 5.0 / 60.0;
  std::vector<double> hours(n_points, 0.0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_points, 16), [&](const auto& range) {
    std::vector<float> factors(range.size());
    LocalTime time = day;
    for (time.hour = 0.5 * kStep_h; time.hour < 24.0; time.hour += kStep_h) {
      const auto position = sun_at(weather, time);
      if (position.apparent_altitude_rad <= 0.0) continue;
      sun(position.direction(), range.begin(), factors);
      for (std::size_t i = 0; i < factors.size(); ++i)
        hours[range.begin() + i] += factors[i] > 0.0F ? kStep_h : 0.0;
    }
  });
  return hours;
}

const char* word_of(Provision level) {
  switch (level) {
    case Provision::minimum:
      return "minimum";
    case Provision::medium:
      return "medium";
    case Provision::high:
      return "high";
    default:
      return "none";
  }
}

Provision provision_of(double target_lx, double minimum_lx) {
  if (target_lx >= 750.0 && minimum_lx >= 500.0) return Provision::high;
  if (target_lx >= 500.0 && minimum_lx >= 300.0) return Provision::medium;
  if (target_lx >= 300.0 && minimum_lx >= 100.0) return Provision::minimum;
  return Provision::none;
}

PlaneMetrics plane_metrics(std::span<const PointMetrics> points) {
  PlaneMetrics plane;
  plane.n_points = points.size();
  if (points.empty()) return plane;
  const auto n = static_cast<double>(points.size());
  std::vector<double> half;
  for (const auto& point : points) {
    constexpr double PointMetrics::*kMembers[] = {
        &PointMetrics::autonomy,          &PointMetrics::continuous_autonomy,
        &PointMetrics::useful_low,        &PointMetrics::useful_supplementary,
        &PointMetrics::useful_autonomous, &PointMetrics::useful_high,
        &PointMetrics::exposure_lx_h,     &PointMetrics::half_daylight_lx,
        &PointMetrics::direct_sun_h};
    for (const auto member : kMembers) plane.mean.*member += point.*member / n;
    plane.spatial_autonomy += (point.autonomy >= 0.5) / n;
    plane.sun_exposure += (point.direct_sun_h > kMostSun_h) / n;
    half.push_back(point.half_daylight_lx);
  }
  plane.target_lx = reached_by(half, 0.5);
  plane.minimum_lx = reached_by(half, 0.95);
  plane.provision = provision_of(plane.target_lx, plane.minimum_lx);
  return plane;
}

}  // namespace dim
