#pragma once

#include <vector>

#include "base/job.hpp"
#include "geometry/line_drawing.hpp"
#include "geometry/perspective.hpp"
#include "geometry/ray_caster.hpp"

namespace dim {

/// Edges of polygons, outer rings and holes, as the camera sees them, the hidden parts taken away.
///
/// Every edge is clipped to the picture, cut where the image of a nearer edge crosses its own and where it
/// goes through a polygon, and the middle of each piece is looked for from the eye: the cuts are exact and
/// nothing depends on a raster. Edges that several polygons share are drawn once, pieces in line are joined,
/// and the answer does not depend on the order of the plates but for the last digits. A polygon's own edges
/// and those that lie on it are not hidden by it. The line where two polygons cross each other away from any
/// edge is not an edge and is not drawn.
///
/// A plate with an open back that is seen from behind is not there. So with a room's bounding surfaces given
/// open backs the camera may stand outside: it looks through the near walls and ceiling into the room, as
/// into a cut-away model. Inside a room nothing is lost by it, as fronts hide all such backs.
///
/// @param plates      near the origin, as RayCaster wants them
/// @param diameter_m  size of the zone: what is within 1e-7 of it counts as touching, what is nearer to the
/// eye
///                    than 1e-6 of it is not drawn
/// @returns segments inside the picture, as `joined` leaves them
/// @throws Interrupted when the job is stopped
std::vector<Segment2> hidden_lines(const std::vector<Plate>& plates, double diameter_m, const Camera& camera,
                                   const Job& job = {});

}  // namespace dim
