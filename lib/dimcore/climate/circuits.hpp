#pragma once

#include <functional>
#include <string>
#include <vector>

#include "climate/control_file.hpp"
#include "climate/lighting_year.hpp"
#include "result/database.hpp"
#include "sky/epw.hpp"

namespace dim {

/// The measuring points that a control file names as sensors, each once.
struct ControlSensors {
  std::vector<std::string> names;   ///< "desk points[2]"
  std::vector<std::size_t> points;  ///< places among the zone's points
};

/// @throws InputError  with the circuit's place: no such plane, sensors or point, or one that no light
/// reaches
ControlSensors sensors_of(const ControlPlan& plan, const Zone& zone);

/// The circuits of a plan on a solved zone. Watts that the plan does not say are those of its luminaires'
/// fittings.
/// @param load  reads a file of presence; the name as written in the plan
/// @throws InputError  no such luminaire or group, no watts known, wrong presence
std::vector<Circuit> circuits_of(const ControlPlan& plan, const ControlSensors& sensors,
                                 const LuminanceDatabase& database, const Weather& weather,
                                 const std::function<std::string(const std::string& name)>& load);

/// Area of all bounding surfaces that face up, m2.
double floor_area_m2(const Zone& zone);

}  // namespace dim
