#include "light/window.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/convex_split.hpp"
#include "scene/corner_behind.hpp"

namespace dim {
namespace {

bool is_convex(const Ring2& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()], &c = ring[(i + 2) % ring.size()];
    const Vec2 ab = b - a, bc = c - b;
    if (ab.x * bc.y - ab.y * bc.x < 0.0) return false;
  }
  return true;
}

std::vector<ConvexRing> convex_parts(const Polygon& polygon, const AreaSampler& area) {
  // Cutting a ring by planes adds corners.
  constexpr std::size_t kMostCorners = ConvexRing::kMostCorners - 8;
  const Frame& frame = polygon.frame();
  std::vector<ConvexRing> parts;
  const auto add = [&](const auto& corners) {
    ConvexRing ring;
    for (const Vec2& p : corners) ring.add(frame.to_world(p));
    parts.push_back(ring);
  };
  const auto& rings = polygon.rings();
  if (rings.size() == 1 && rings[0].size() <= kMostCorners && is_convex(rings[0]))
    add(rings[0]);
  else
    for (const auto& triangle : area.triangles()) add(triangle);
  return parts;
}

// Whether nothing of the zone lies before the window's outer face.
bool is_open_outside(const Zone& zone, const Frame& frame) {
  return !any_corner_behind(zone, frame, 1e-7 * zone.diameter_m);
}

std::size_t group_of(Windows& all, const std::string& name) {
  const auto known = std::find_if(all.groups.begin(), all.groups.end(),
                                  [&](const WindowGroup& group) { return group.name == name; });
  if (known != all.groups.end()) return static_cast<std::size_t>(known - all.groups.begin());
  all.groups.push_back({name, {}, {}});
  return all.groups.size() - 1;
}

void add_window(const Zone& zone, const Polygon& polygon, int plate, const std::string& group, Windows& all) {
  Window window;
  window.plate = plate;
  window.polygon = polygon;
  window.area = AreaSampler(polygon.rings());
  window.parts = convex_parts(polygon, window.area);
  window.group = group_of(all, group);
  window.open_outside = is_open_outside(zone, polygon.frame());
  all.groups[window.group].windows.push_back(all.windows.size());
  all.windows.push_back(std::move(window));
}

// States of a group: what its windows are as they stand, then the others by name in order of appearance.
void set_states(const Zone& zone, Windows& all) {
  const auto surface_of = [&](std::size_t window) -> const Surface* {
    const int plate = all.windows[window].plate;
    return plate < 0 ? nullptr : &zone.surfaces[static_cast<std::size_t>(plate)];
  };
  for (auto& group : all.groups) {
    const Surface* first = group.windows.empty() ? nullptr : surface_of(group.windows.front());
    group.states = {first ? zone.finishes[static_cast<std::size_t>(first->finish)].name : "open"};
    for (const std::size_t w : group.windows) {
      if (!surface_of(w)) continue;
      for (const auto& state : surface_of(w)->states)
        if (std::find(group.states.begin(), group.states.end(), state.name) == group.states.end())
          group.states.push_back(state.name);
    }
    for (const std::size_t w : group.windows) {
      const Surface* surface = surface_of(w);
      auto& finishes = all.windows[w].finish_of_state;
      finishes.assign(group.states.size(), surface ? surface->finish : -1);
      if (!surface) continue;
      for (const auto& state : surface->states) {
        const auto at = std::find(group.states.begin(), group.states.end(), state.name) - group.states.begin();
        finishes[static_cast<std::size_t>(at)] = state.finish;
      }
    }
  }
}

}  // namespace

Windows find_windows(const Zone& zone) {
  Windows all;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const Surface& surface = zone.surfaces[s];
    if (is_window(zone, surface)) add_window(zone, surface.polygon, static_cast<int>(s), surface.group, all);
  }
  for (const auto& opening : zone.openings) add_window(zone, opening, -1, kOpenings, all);
  all.dome = !zone.closed && zone.openings.empty();
  if (all.dome) all.groups.push_back({kOpenings, {}, {}});
  set_states(zone, all);
  return all;
}

Frame klems_frame(const Window& window) {
  Frame frame = window.frame();
  const Vec3 up = Vec3(0, 0, 1) - frame.n.z * frame.n;
  frame.v = glm::length(up) > 1e-6 ? glm::normalize(up) : Vec3(0, 1, 0);
  frame.u = glm::cross(frame.v, frame.n);
  return frame;
}

}  // namespace dim
