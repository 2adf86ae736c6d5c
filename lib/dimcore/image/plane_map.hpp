#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"
#include "image/drawing.hpp"

namespace dim {

/// A quantity at the points of a measuring plane, to be drawn as a plan in false colours.
struct PlaneMap {
  std::string title;
  std::string unit;
  Polygon plane;
  int nu = 1, nv = 1;  ///< of its grid
  std::vector<std::pair<Vec3, double>> values;  ///< at points; NaN where there is none (grey)
};

/// Every point with the part of the plane that it stands for, a linear scale from 0 and its legend. Planes that face up
/// are drawn with +y up, others with their own second axis.
Drawing plane_map_drawing(const PlaneMap& map);

}  // namespace dim
