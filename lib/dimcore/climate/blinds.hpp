#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "climate/annual.hpp"
#include "climate/stored_coefficients.hpp"

namespace dim {

/// How blinds answer the sun.
enum class BlindLaw {
  direct_sun,   ///< closed while too many points get too much direct sun through the open windows
  irradiance,   ///< closed by the irradiance of the outer face of the glass
  illuminance,  ///< closed by its illuminance
};

/// When a group of windows changes its state. The defaults of `direct_sun` are the rule of IES LM-83: closed while
/// more than 2 % of the points get more than 1,000 lx.
struct BlindPlan {
  std::string windows;  ///< group
  std::string closed;   ///< its state while closed; open it is as the zone file or `--state` has it
  BlindLaw law = BlindLaw::direct_sun;
  double most_sun_lx = 1000.0;
  double most_points = 0.02;         ///< share of the points, 0..1
  std::vector<std::string> points;   ///< planes and sensors that count; empty: all planes, or all sensors without one
  double close_above = 0.0;          ///< W/m2 or lx
  double open_below = 0.0;           ///< at most `close_above`
  Place place;
};

/// One group of windows through the steps. [n_steps]
struct BlindYear {
  std::string windows, closed_state;
  std::vector<bool> closed;
};

/// Blinds that close above one level and stay closed above another; open before the first step. [n_values]
std::vector<bool> closed_by_level(const std::vector<double>& values, double close_above, double open_below);

/// Windows of a database operated through a year, and the light that they then let in.
struct OperatedWindows {
  std::vector<BlindYear> blinds;
  std::vector<WindowPart> parts;  ///< of all measuring points
};

/// @param states  of windows that no plan operates, and of those while open
/// @throws InputError  with a plan's place: no such group, state, plane or sensors; two plans for one group
/// @throws Interrupted
OperatedWindows operate(const LuminanceDatabase& database, const WindowStates& states,
                        const std::vector<BlindPlan>& plans, const AnnualSky& sky, const Job& job = {});

}  // namespace dim
