#pragma once

#include <vector>

#include "base/error.hpp"
#include "scene/shell_edges.hpp"
#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

namespace dim {

struct ShellCheck {
  bool closed = false;
  double volume_m3 = 0.0;
  std::vector<LeakingEdge> leaking;  ///< edges through which light leaves the zone
};

/// Examines the bounding surfaces (parents before features are cut from them) as a shell.
///
/// Surfaces that share edges make a part of the shell. A part is inner where it lies inside another
/// (furniture written as [[surface]]) and outer otherwise; outer parts face inwards, inner ones outwards. The
/// volume is that of the outer parts (divergence theorem about each part's centre).
///
/// Reports surfaces of a closed part that face the wrong way. Warns of up to three edges that nothing meets,
/// with their ends in the file's coordinates; of surfaces that seem turned round in a part that is not
/// closed.
/// @param touch_m  distance within which edges are the same
ShellCheck check_shell(const std::vector<Surface>& surfaces, const ZoneFrame& frame, double touch_m,
                       Problems& problems, Warnings& warnings);

}  // namespace dim
