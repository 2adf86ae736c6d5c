#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/vec.hpp"

namespace dim {

/// Limits of ESP-r's casual gain control (building.h and ecasctl.F of V13.3.15).
inline constexpr int kMostLightingZones = 4;
inline constexpr int kMostSensors = 9;
inline constexpr int kMostCoefficientSets = 5;
inline constexpr int kMostDelay = 6;
inline constexpr int kMostDayTypes = 8;
inline constexpr int kMostEspSurfaces = 100;
inline constexpr std::size_t kEspPatches = 145;

/// How a lighting zone gets its illuminance.
enum class EspSensorType {
  analytical = 1,
  daylight_factors = 2,
  external = 3,
  coupling = 4,
  coefficients = 5
};

struct EspSensor {
  Vec3 position_m{0.0};
  Vec3 normal{0, 0, 1};
  int set = 0;  ///< 1..5, of daylight coefficients
  /// A stage is a state of the glazing; 145 values D = E / (L 2 pi / 145) each, in the order of
  /// SkyPatches(1). One or two.
  std::vector<std::vector<double>> stages;
};

/// Daylight factors over the glazing's visible transmittance, as fractions: ESP-r multiplies by it.
struct EspWindow {
  int surface = 1;              ///< of the zone's geometry, from 1
  std::vector<double> factors;  ///< [n_sensors]
};

struct EspLightingZone {
  double setpoint_lx = 500.0;
  double switch_off = 1.5;
  double min_light = 0.1;
  double min_power = 0.3;
  int delay_steps = 0;
  double share = 1.0;  ///< of the zone's lighting gain
  EspSensorType type = EspSensorType::daylight_factors;
  std::vector<EspSensor> sensors;
  std::vector<EspWindow> windows;  ///< of type 2
  int law = 3;                     ///< -1, 0, 1, 2, 3, 4, 31, 32
  double night_lx = 0.0;           ///< laws 31 and 32
  double slope_per_lx = 0.0;
  int external_surface = 1;  ///< of type 3: looks out vertically from it
};

/// A *.cgc file.
struct CasualGainControl {
  std::string description;
  std::vector<std::string> comments;              ///< lines in front, without their #; not read back
  std::vector<int> slots;                         ///< gain controlled each day type, 0..7, 0 none
  std::vector<std::pair<int, int>> active_hours;  ///< each day type
  std::vector<EspLightingZone> zones;
};

/// @throws LimitError  a number of sensors, delay or switch-off factor that ESP-r does not take
void check_lighting_zone(const EspLightingZone& zone);

/// The text of the file.
/// @throws LimitError  what ESP-r cannot hold: more than 4 lighting zones, 9 sensors, 5 coefficient sets, …
std::string write_cgc(const CasualGainControl& control);

/// Reads a file strictly. @throws InputError  everything outside the grammar and its limits, with file and
/// line
CasualGainControl read_cgc(std::string_view text, const std::string& file);

}  // namespace dim
