#include "scene/task_area.hpp"

#include <algorithm>

#include "geometry/clip.hpp"

namespace dim {
namespace {

constexpr double kLevel = 0.99;
// Of the zone: a floor so little below is at the same height.
constexpr double kSameHeight = 1e-9;

bool looks_up(const Surface& surface) { return !surface.outside && surface.polygon.normal().z > kLevel; }

// What of a region in the frame's plane has something below it that looks up.
Region2 over_floors(const Region2& region, const Frame& frame, const Zone& zone) {
  Region2 beyond = region;
  for (const Surface& surface : zone.surfaces)
    if (looks_up(surface) && frame.height(surface.polygon.centroid()) <= kSameHeight * zone.diameter_m)
      beyond = clip_difference(beyond, projected(surface.polygon, frame));
  constexpr double kSliver = 1e-6;
  return without_slivers(clip_difference(region, beyond), kSliver * zone.diameter_m);
}

// How far the floor lies below the middle of a polygon: the highest floor that is there, else the highest of all.
double depth_of_floor(const Polygon& polygon, const Zone& zone) {
  constexpr double kNone = -1.0;
  const Frame& frame = polygon.frame();
  double under = kNone, anywhere = kNone;
  for (const Surface& surface : zone.surfaces) {
    if (!looks_up(surface) || !surface.bounding) continue;
    const double depth = -frame.height(surface.polygon.centroid());
    if (depth < -kSameHeight * zone.diameter_m) continue;
    const Vec2 local = surface.polygon.frame().to_local(polygon.centroid()), size = surface.polygon.size_m();
    if (anywhere < 0.0 || depth < anywhere) anywhere = std::max(0.0, depth);
    const bool is_there = local.x >= 0.0 && local.y >= 0.0 && local.x <= size.x && local.y <= size.y;
    if (is_there && (under < 0.0 || depth < under)) under = std::max(0.0, depth);
  }
  return under >= 0.0 ? under : std::max(0.0, anywhere);
}

}  // namespace

TaskArea::TaskArea(const Polygon& task, double surrounding_m, double background_m, const Zone& zone) {
  const Region2 middle = task.rings(), near = grown(middle, surrounding_m), far = grown(near, background_m);
  const auto add = [&](const char* suffix, const Region2& outer, const Region2& inner, double width_m, double depth_m) {
    Frame frame = task.frame();
    frame.origin -= depth_m * frame.n;
    Region2 band = over_floors(clip_difference(outer, inner), frame, zone);
    bands_.push_back({suffix, band.empty() ? Polygon() : Polygon(frame, std::move(band)), width_m});
  };
  if (surrounding_m > 0.0) add("surrounding", near, middle, surrounding_m, 0.0);
  if (background_m > 0.0) add("background", far, near, background_m, depth_of_floor(task, zone));
}

}  // namespace dim
