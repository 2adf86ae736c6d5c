#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dim {

/// How lamps answer daylight. The figures are the numbers that ESP-r knows a law by; none for -1000 and
/// below.
enum class Law {
  on = -1,
  off = 0,
  on_off = 1,
  step = 2,
  dimming = 3,
  hunt = 4,
  integral_reset = 31,
  closed_loop = 32,
  occupancy = -1000  ///< on while somebody is there; ESP-r has no such law
};

/// The words a control file uses: "on", "off", "on-off", "step", "dimming", "hunt", "integral-reset",
/// "closed-loop", "occupancy".
std::optional<Law> law_of(const std::string& word);
std::string word_of(Law law);
std::vector<std::string> law_words();

struct ControlSettings {
  Law law = Law::on;
  double setpoint_lx = 500.0;
  double switch_off = 1.5;       ///< lights go out where daylight and lamps exceed this times the setpoint
  double min_light = 0.1;        ///< least light output of a dimmed lamp, share of full, below 1
  double min_power = 0.3;        ///< what it then takes, share of full
  int delay_steps = 0;           ///< steps above the switch-off level before lights go out
  double night_lx = 500.0;       ///< sensor's illuminance by the lamps alone (integral reset, closed loop)
  double slope_per_lx = -0.002;  ///< of the closed loop's output, negative
  std::uint64_t seed = 1;        ///< of switching at arrival
};

struct LampState {
  double light = 0.0;  ///< share of full output
  double power = 0.0;  ///< share of full power
};

/// Power of a lamp dimmed to a share of its light: q + (1 - q)(f - m)/(1 - m).
double dimmed_power(double light, const ControlSettings& settings);

/// What lamps do step by step under a law. It remembers for how many steps daylight has been above the
/// switch-off level and whether the lights are lit.
class Controller {
 public:
  /// @param circuit  number of the circuit, which makes the chances of its arrivals its own
  Controller(const ControlSettings& settings, std::uint64_t circuit)
      : settings_(settings), circuit_(circuit) {}

  /// @param daylight_lx  mean of the sensors; `least_lx` the least of them
  /// @param present      somebody is there or has left within the hold-on time
  LampState next(double daylight_lx, double least_lx, bool present);

 private:
  LampState lit(double daylight_lx, double least_lx);
  /// Off once the level was exceeded long enough; until then `waiting`.
  LampState switched_off(const LampState& waiting) const;

  ControlSettings settings_;
  std::uint64_t circuit_;
  std::uint64_t step_ = 0;
  int n_above_ = 0;
  bool was_present_ = false;
  bool is_lit_ = false;
};

}  // namespace dim
