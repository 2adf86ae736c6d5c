#include "climate/lighting_year.hpp"

#include <algorithm>
#include <limits>

namespace dim {
namespace {

struct Measured {
  double mean_lx = 0.0, least_lx = 0.0;
};

Measured measured(const Circuit& circuit, const std::vector<SensorYear>& sensors, std::size_t step) {
  if (circuit.sensors.empty()) return {};
  Measured m{0.0, std::numeric_limits<double>::max()};
  for (const std::size_t s : circuit.sensors) {
    const double lx = sensors[s].total_lx(step);
    m.mean_lx += lx / static_cast<double>(circuit.sensors.size());
    m.least_lx = std::min(m.least_lx, lx);
  }
  return m;
}

}  // namespace

std::vector<CircuitYear> run_circuits(const std::vector<Circuit>& circuits,
                                      const std::vector<SensorYear>& sensors, std::size_t n_steps) {
  std::vector<CircuitYear> years(circuits.size());
  for (std::size_t c = 0; c < circuits.size(); ++c) {
    Controller controller(circuits[c].settings, c);
    for (std::size_t step = 0; step < n_steps; ++step) {
      const Measured m = measured(circuits[c], sensors, step);
      years[c].lamps.push_back(controller.next(m.mean_lx, m.least_lx, circuits[c].present[step]));
      years[c].watts.push_back(circuits[c].watts * years[c].lamps.back().power);
    }
  }
  return years;
}

CircuitEnergy energy_of(const Circuit& circuit, const CircuitYear& year, double step_h) {
  CircuitEnergy energy;
  for (std::size_t step = 0; step < year.watts.size(); ++step) {
    energy.lamps_kWh += year.watts[step] * step_h / 1000.0;
    energy.standby_kWh += circuit.standby_W * step_h / 1000.0;
    if (circuit.present[step]) energy.uncontrolled_kWh += circuit.watts * step_h / 1000.0;
  }
  return energy;
}

double leni_kWh_m2(const std::vector<CircuitEnergy>& circuits, double area_m2) {
  double sum_kWh = 0.0;
  for (const auto& circuit : circuits) sum_kWh += circuit.lamps_kWh + circuit.standby_kWh;
  return sum_kWh / area_m2;
}

}  // namespace dim
