#pragma once

#include <vector>

#include "base/error.hpp"
#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

namespace dim {

struct ShellCheck {
  bool closed = false;
  double volume_m3 = 0.0;  ///< enclosed by the bounding surfaces; negative where they face outwards
};

/// Whether the bounding surfaces (features not counted, their parents not yet cut) make a closed shell.
ShellCheck check_shell(const std::vector<Surface>& surfaces, const ZoneFrame& frame, double touch_m,
                       Problems& problems, Warnings& warnings);

}  // namespace dim
