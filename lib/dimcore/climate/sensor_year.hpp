#pragma once

#include <string>
#include <vector>

#include "climate/annual.hpp"
#include "climate/lighting_year.hpp"

namespace dim {

/// Some of the points, in the order given.
DaylightCoefficients at_points(const DaylightCoefficients& coefficients,
                               const std::vector<std::size_t>& points);
SunFactors at_points(const SunFactors& sun, const std::vector<std::size_t>& points);
std::vector<WindowPart> at_points(const std::vector<WindowPart>& parts, const std::vector<std::size_t>& points);

/// What sensors measure at every step, from daylight coefficients. @throws Interrupted
std::vector<SensorYear> sensor_years(const std::vector<std::string>& names, const AnnualSky& sky,
                                     const std::vector<WindowPart>& parts, const Job& job = {});

/// The same by the paper's equation (24), from daylight factors. @param factors  0..1, [n_sensors]
std::vector<SensorYear> paper_sensor_years(const std::vector<std::string>& names, const Weather& weather,
                                           const std::vector<double>& factors, const SunFactors& sun);

/// Every step cut into `n` of the same irradiance, each with its own sun.
Weather subdivided(const Weather& weather, int n);

/// The steps of some days, both with them; over the new year where the first is later than the last.
Weather between(const Weather& weather, int first_month, int first_day, int last_month, int last_day);

}  // namespace dim
