#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/contour_field.hpp"
#include "image/contour_plan.hpp"
#include "image/drawing.hpp"

namespace dim {

/// A planar field and the plan it is to be drawn on.
struct ContourMap {
  Polygon polygon;   ///< where the field is
  ValueGrid values;  ///< over the polygon's bounding rectangle
  std::vector<double> levels;
  PlanFrame plan;
  std::vector<PlanLine> below;
  std::optional<Vec2> north;  ///< in the plan
  std::string title, quantity, unit;
  std::vector<std::pair<std::string, std::string>> figures;  ///< said beside the plan: name, value
  bool filled = false;                                       ///< colours between the lines
  bool with_values = false;  ///< figures at the middles of the squares, as many as can be read
  int size_px = 1000;        ///< longer side of the plan; the rest is added to it
};

/// Longer sides that can be asked for.
inline constexpr int kLeastPlan_px = 200, kMostPlan_px = 8000;

/// Isolines with their values on them over the plan, with scale bar, north, figures and, where it is filled,
/// a legend of the colours. Lines follow smooth_field and end at the polygon's edge and at squares without
/// value.
Drawing contour_drawing(const ContourMap& map);

}  // namespace dim
