#pragma once

#include "sky/epw.hpp"
#include "sky/sky_spec.hpp"
#include "sky/sun_position.hpp"

namespace dim {

/// Where the sun stands at a moment of the weather's own clock.
SunPosition sun_at(const Weather& weather, const LocalTime& time);

/// The sun that stands for a step: at its middle, or in the middle of the part that has the sun up where only
/// part of it has. Up is the apparent altitude of the sun's centre above 0.
SunPosition sun_of(const Weather& weather, const WeatherStep& step);

/// Sky and sun of a step.
SkyAndSun sky_and_sun_of(const Weather& weather, const WeatherStep& step);

/// Counts the steps with a beam although the sun is down all the while: their beam is left out.
Warnings beam_without_sun(const Weather& weather, const std::string& file);

/// Sky and sun of one moment: irradiance of the step that holds it, the sun where it stands at that moment.
/// @throws InputError  a moment that the file does not hold
SkyAndSun sky_and_sun_of(const Weather& weather, const WeatherMoment& moment);

}  // namespace dim
