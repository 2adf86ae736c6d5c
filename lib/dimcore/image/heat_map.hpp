#pragma once

#include <string>
#include <vector>

#include "image/drawing.hpp"

namespace dim {

/// A value at every step of a year, to be drawn by day (across) and hour (up).
struct HeatMap {
  std::string title;
  std::string unit;
  int steps_per_day = 24;
  std::vector<double> values;  ///< [n_days x steps_per_day], from the first step of the first day
};

/// Days across, hours up, the colour of colour_map on a round logarithmic scale, a legend to the right; what
/// is not above 0 has its lowest colour.
Drawing heat_map_drawing(const HeatMap& map);

}  // namespace dim
