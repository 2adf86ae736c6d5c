#pragma once

#include <optional>
#include <vector>

#include "base/job.hpp"
#include "result/content.hpp"

namespace dim {

/// Where a plan lies: u to the right, v up, n towards whoever looks at it; and what it shows of that plane,
/// m.
struct PlanFrame {
  Frame frame;
  Vec2 low_m{0.0}, high_m{0.0};

  Vec2 to_plan(const Vec3& p) const { return frame.to_local(p); }
  double width_m() const { return high_m.x - low_m.x; }
  double height_m() const { return high_m.y - low_m.y; }
};

/// The plan of a measuring plane or surface. What is level is seen from above with +y up the page, whichever
/// side is lit, as plans are; anything else from its lit side with the vertical up. It shows the room, but of
/// a plane much smaller than the room only its surroundings.
PlanFrame plan_frame(const Zone& zone, const Polygon& polygon);

enum class PlanStroke {
  edge,      ///< of furniture and of whatever else is seen
  wall,      ///< a bounding surface seen edge-on
  window,    ///< the same, glazed
  luminaire  ///< luminous opening
};

struct PlanLine {
  PlanStroke stroke = PlanStroke::edge;
  std::vector<Vec2> points_m;  ///< in the plan
};

/// The room as it is seen on the plan of a measuring plane, hidden parts left out: of a level plane from just
/// below the luminaires (else from above the room), of any other from the plane itself.
/// @throws Interrupted
std::vector<PlanLine> plan_of_room(const Zone& zone, const std::vector<ShownLuminaire>& luminaires,
                                   const PlanFrame& plan, const Job& job);

/// The outline of a surface and of what lies on it (windows, doors, a board).
std::vector<PlanLine> plan_of_surface(const Zone& zone, std::size_t surface, const PlanFrame& plan);

/// Symbols of luminaires: the outline of each opening with its diagonals, of small ones a circle with a
/// cross. Those off the plan are left out.
/// @param least_m  openings smaller than this in both directions are drawn of this size
std::vector<PlanLine> luminaire_symbols(const std::vector<ShownLuminaire>& luminaires, const PlanFrame& plan,
                                        double least_m);

/// Direction of north in the plan, unit; nothing without a site or where the plan is not level.
std::optional<Vec2> north_in_plan(const Zone& zone, const PlanFrame& plan);

}  // namespace dim
