#pragma once

#include <string>
#include <vector>

#include "climate/circuits.hpp"
#include "climate/stored_coefficients.hpp"
#include "esp/casual_gain_control.hpp"
#include "esp/temporal_file.hpp"

namespace dim {

/// What the options about ESP-r's files say.
struct EspOptions {
  std::string zone;
  double convective = 0.4;
  std::string gains_file;
  int year = 0;                            ///< 0: that of the weather's first row
  int sensor_type = 5;                     ///< 2 or 5
  std::vector<std::string> second_states;  ///< GROUP=STATE
  std::vector<std::string> surfaces;       ///< GROUP=NUMBER
  int workaround_surface = 0;              ///< 0: none
};

/// Turns circuits and coefficients into what ESP-r's files hold.
class EspExport {
 public:
  /// @param lum  path of the database, for messages
  EspExport(const EspOptions& options, const ControlPlan& plan, const ControlSensors& sensors,
            const std::vector<Circuit>& circuits, const LuminanceDatabase& database, const std::string& lum);

  /// @throws LimitError  beyond what ESP-r holds
  TemporalGains temporal_gains(const Weather& weather, const std::vector<CircuitYear>& years) const;
  /// The text of a casual gain control. @throws LimitError, InputError
  std::string gain_control(const WindowStates& states, const std::vector<std::string>& state_texts) const;

 private:
  std::string zone_name() const;
  EspLightingZone lighting_zone(std::size_t circuit) const;
  void add_coefficients(const WindowStates& states, const std::vector<std::string>& state_texts,
                        CasualGainControl& control) const;
  void add_factors(const WindowStates& states, CasualGainControl& control) const;

  const EspOptions& options_;
  const ControlPlan& plan_;
  const ControlSensors& sensors_;
  const std::vector<Circuit>& circuits_;
  const LuminanceDatabase& database_;
  const std::string& lum_;
};

/// Reads an ESP-r file of either grammar strictly; says what it is.
/// @throws InputError  everything outside the grammar and its limits
std::string checked_esp_file(const std::string& text, const std::string& file);

}  // namespace dim
