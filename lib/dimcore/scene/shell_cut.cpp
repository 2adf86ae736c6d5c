#include "scene/shell_cut.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/clip.hpp"

namespace dim {
namespace {

/// Where the outline of a body crosses a plane; each edge of a box comes twice.
std::vector<Vec3> section(const std::vector<Surface>& surfaces, const BodyFaces& body, const Frame& plane,
                          double touch_m) {
  std::vector<Vec3> points;
  for (std::size_t f = body.first; f < body.first + body.n; ++f)
    for (const auto& ring : surfaces[f].polygon.corners())
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        const double height_a = plane.height(a), height_b = plane.height(b);
        if (std::min(height_a, height_b) > -touch_m || std::max(height_a, height_b) < touch_m) continue;
        points.push_back(a + (b - a) * (height_a / (height_a - height_b)));
      }
  return points;
}

bool lies_within(const std::vector<Vec3>& section, const Polygon& wall, double touch_m) {
  for (const auto& a : section)
    for (const auto& b : section)
      if (!wall.contains(wall.frame().to_local((a + b) / 2.0), touch_m)) return false;
  return !section.empty();
}

/// Counter-clockwise seen from behind the plane.
Ring3 ring_behind(const std::vector<Vec3>& section, const Frame& plane, double touch_m) {
  Ring3 ring;
  Vec2 middle(0.0);
  for (const auto& p : section) {
    if (std::any_of(ring.begin(), ring.end(), [&](const Vec3& q) { return glm::length(p - q) <= touch_m; })) continue;
    ring.push_back(p);
    middle += plane.to_local(p);
  }
  middle /= static_cast<double>(ring.size());
  const auto angle = [&](const Vec3& p) {
    const Vec2 d = plane.to_local(p) - middle;
    return std::atan2(d.y, d.x);
  };
  std::sort(ring.begin(), ring.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) > angle(b); });
  return ring;
}

/// Not a sliver that leaves nothing to close.
bool is_wide(const Ring3& ring, double touch_m) {
  double around_m = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) around_m += glm::length(ring[(i + 1) % ring.size()] - ring[i]);
  return glm::length(newell(ring)) > touch_m * around_m;
}

/// A square of the polygon's plane on the front side of another plane, larger than the polygon.
Region2 front_half(const Polygon& polygon, const Frame& plane) {
  const Frame& frame = polygon.frame();
  const Vec2 slope{glm::dot(frame.u, plane.n), glm::dot(frame.v, plane.n)};
  const Vec2 uphill = glm::normalize(slope), along{uphill.y, -uphill.x}, middle = polygon.size_m() / 2.0;
  const Vec2 on_line = middle - uphill * (plane.height(frame.to_world(middle)) / glm::length(slope));
  const double reach = 2.0 * glm::length(polygon.size_m());
  return {{on_line - reach * along, on_line + reach * along, on_line + reach * along + 2.0 * reach * uphill,
           on_line - reach * along + 2.0 * reach * uphill}};
}

void clip_behind(Polygon& polygon, const Frame& plane, double touch_m) {
  bool any_behind = false, any_before = false;
  for (const auto& ring : polygon.corners())
    for (const auto& p : ring) {
      any_behind |= plane.height(p) < -touch_m;
      any_before |= plane.height(p) > touch_m;
    }
  if (!any_behind) return;
  Region2 rest;
  if (any_before) rest = without_slivers(clip_intersection(polygon.rings(), front_half(polygon, plane)), touch_m);
  polygon = rest.empty() ? Polygon{} : Polygon(polygon.frame(), std::move(rest));
}

std::vector<std::size_t> surfaces_of(const std::vector<Surface>& surfaces, const BodyFaces& body) {
  std::vector<std::size_t> own;
  for (std::size_t f = body.first; f < body.first + body.n; ++f) {
    own.push_back(f);
    if (body.n == 1 && surfaces[f].twin >= 0) own.push_back(static_cast<std::size_t>(surfaces[f].twin));
  }
  std::vector<std::size_t> all = own;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (std::any_of(own.begin(), own.end(), [&](std::size_t f) { return is_ancestor(surfaces, f, i); }))
      all.push_back(i);
  return all;
}

// The end takes the place of a face that is gone, so that it keeps the face's name; else it is one more.
void close_box(std::vector<Surface>& surfaces, std::vector<SurfaceLink>& links, const BodyFaces& body,
               const Ring3& end) {
  const auto first = surfaces.begin() + static_cast<std::ptrdiff_t>(body.first);
  const auto gone = std::find_if(first, first + static_cast<std::ptrdiff_t>(body.n),
                                 [](const Surface& face) { return !(face.polygon.area_m2() > 0.0); });
  if (gone != first + static_cast<std::ptrdiff_t>(body.n)) {
    gone->polygon = Polygon(end);
    return;
  }
  Surface face = surfaces[body.first];
  face.name += ".end";
  face.polygon = Polygon(end);
  surfaces.push_back(std::move(face));
  links.push_back({"", {}, true});
}

}  // namespace

std::vector<ShellCut> find_shell_cuts(const std::vector<Surface>& surfaces, const BodyFaces& body,
                                      const std::vector<Vec3>& extremes, const InsideTest& test, double touch_m) {
  std::vector<ShellCut> cuts;
  for (std::size_t wall = 0; wall < surfaces.size(); ++wall) {
    const Surface& surface = surfaces[wall];
    if (!surface.bounding || surface.parent >= 0) continue;
    const Frame& plane = surface.polygon.frame();
    if (!lies_within(section(surfaces, body, plane, touch_m), surface.polygon, touch_m)) continue;
    const bool all_outside = std::all_of(extremes.begin(), extremes.end(), [&](const Vec3& p) {
      return plane.height(p) > -touch_m || test.outside(p);
    });
    if (all_outside) cuts.push_back({body, wall});
  }
  return cuts;
}

void cut_at_shell(std::vector<Surface>& surfaces, std::vector<SurfaceLink>& links, const std::vector<Surface>& whole,
                  const std::vector<ShellCut>& cuts, double touch_m) {
  for (const auto& cut : cuts) {
    const Frame& plane = whole[cut.wall].polygon.frame();
    for (const std::size_t i : surfaces_of(surfaces, cut.body)) clip_behind(surfaces[i].polygon, plane, touch_m);
    if (cut.body.n == 1) continue;
    const Ring3 end = ring_behind(section(whole, cut.body, plane, touch_m), plane, touch_m);
    if (is_wide(end, touch_m)) close_box(surfaces, links, cut.body, end);
  }
}

}  // namespace dim
