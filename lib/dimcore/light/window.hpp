#pragma once

#include <string>
#include <vector>

#include "geometry/area_sampler.hpp"
#include "geometry/convex_ring.hpp"
#include "light/outside_light.hpp"
#include "reflection/glazing.hpp"
#include "scene/zone.hpp"

namespace dim {

/// A flat part of the shell that light comes in through: glass, or an opening.
struct Window {
  int plate = -1;       ///< the glazed surface; -1 for what is open
  Polygon polygon;      ///< facing into the zone
  std::vector<ConvexRing> parts;  ///< convex pieces of it
  AreaSampler area;
  std::size_t group = 0;
  std::vector<int> finish_of_state;  ///< [n_states of its group]; -1 where it is open
  bool open_outside = true;          ///< nothing of the zone or its surroundings lies before its outer face

  const Frame& frame() const { return polygon.frame(); }
};

/// Windows that are lit and switched together. The first state is how the zone file has them.
struct WindowGroup {
  std::string name;
  std::vector<std::string> states;
  std::vector<std::size_t> windows;
};

/// All windows of a zone. Windows of a group that lack one of its states keep their own finish in it.
struct Windows {
  std::vector<Window> windows;
  std::vector<WindowGroup> groups;
  /// Open in ways that are known to rays only: everything that a ray from inside does not meet is outside. A group
  /// of its own, the last, without windows.
  bool dome = false;

  bool any() const { return !groups.empty(); }
};

/// Names of groups that are no window's.
inline constexpr char kOpenings[] = "openings";

Windows find_windows(const Zone& zone);

/// A frame of the window for directions of the Klems basis: z into the zone, y as far up as it goes.
Frame klems_frame(const Window& window);

}  // namespace dim
