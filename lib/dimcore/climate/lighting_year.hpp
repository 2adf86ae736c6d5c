#pragma once

#include <string>
#include <vector>

#include "climate/control_law.hpp"

namespace dim {

/// What a sensor measures at every step. [n_steps]
struct SensorYear {
  std::string name;
  std::vector<float> sky_lx;  ///< of sky and ground
  std::vector<float> sun_lx;
  double total_lx(std::size_t step) const {
    return static_cast<double>(sky_lx[step]) + static_cast<double>(sun_lx[step]);
  }
};

/// A circuit with all that its law needs to be run.
struct Circuit {
  std::string name;
  double watts = 0.0;                ///< at full light
  double standby_W = 0.0;            ///< day and night
  std::vector<std::size_t> sensors;  ///< places in the list of sensors
  ControlSettings settings;
  std::vector<bool> present;  ///< [n_steps] somebody is there, hold-on included
};

/// What a circuit does at every step. [n_steps]
struct CircuitYear {
  std::vector<LampState> lamps;
  std::vector<double> watts;  ///< of the lamps, without standby
};

/// Runs the law of every circuit through the steps.
std::vector<CircuitYear> run_circuits(const std::vector<Circuit>& circuits,
                                      const std::vector<SensorYear>& sensors, std::size_t n_steps);

/// Energy of a circuit over the steps given.
struct CircuitEnergy {
  double lamps_kWh = 0.0;
  double standby_kWh = 0.0;
  double uncontrolled_kWh = 0.0;  ///< at full light whenever somebody is there
};
CircuitEnergy energy_of(const Circuit& circuit, const CircuitYear& year, double step_h);

/// Lighting energy numeric indicator of EN 15193-1, kWh/m2 a year: lamps and standby of all circuits over the
/// area, for steps that cover a year.
double leni_kWh_m2(const std::vector<CircuitEnergy>& circuits, double area_m2);

}  // namespace dim
