#pragma once

#include <vector>

#include "scene/zone.hpp"

namespace dim {

/// What lies around a task area: the band of its immediate surrounding at its height, then that of the background, on
/// the floor below. What of them has no floor below, beyond the walls, is left out.
class TaskArea {
 public:
  struct Band {
    const char* suffix;  ///< "surrounding", "background"
    Polygon polygon;     ///< without rings where nothing is left of it
    double width_m;
  };

  /// @param task           level, looking up
  /// @param surrounding_m  width of the band around the task; 0: none
  /// @param background_m   width of the band around that; 0: none
  /// @param zone           its surfaces: those that look up are what a band is above
  TaskArea(const Polygon& task, double surrounding_m, double background_m, const Zone& zone);

  const std::vector<Band>& bands() const { return bands_; }

 private:
  std::vector<Band> bands_;
};

}  // namespace dim
