#include "scene/shell_cut.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/clip.hpp"
#include "geometry/convex_body.hpp"
#include "scene/coplanar_pairs.hpp"

namespace dim {
namespace {

ConvexBody shape_of(const std::vector<Surface>& surfaces, const BodyFaces& body) {
  if (body.n == 1) return hull_of(surfaces[body.first].polygon);
  ConvexBody shape;
  for (std::size_t f = body.first; f < body.first + body.n; ++f)
    shape.faces.push_back(surfaces[f].polygon.corners().front());
  return shape;
}

std::vector<const Polygon*> walls_through(const std::vector<Surface>& surfaces, const ConvexBody& body,
                                          double touch_m) {
  std::vector<const Polygon*> walls;
  for (const auto& surface : surfaces)
    if (surface.bounding && surface.parent < 0 && pierces(surface.polygon, body, touch_m))
      walls.push_back(&surface.polygon);
  return walls;
}

bool in_plane(const Polygon& wall, const Frame& plane, double touch_m) {
  return glm::dot(wall.normal(), plane.n) > 0.0 && lies_in_plane(wall, plane, touch_m);
}

std::vector<Frame> planes_of(const std::vector<const Polygon*>& walls, double touch_m) {
  std::vector<Frame> planes;
  for (const auto* wall : walls)
    if (std::none_of(planes.begin(), planes.end(), [&](const Frame& p) { return in_plane(*wall, p, touch_m); }))
      planes.push_back(wall->frame());
  return planes;
}

Frame turned(const Frame& plane) { return {plane.origin, plane.v, plane.u, -plane.n}; }

/// Whether walls of one plane close it where the section lies.
bool is_covered(const Ring3& section, const Frame& plane, const std::vector<const Polygon*>& walls, double touch_m) {
  Region2 open = section_region(section, plane, touch_m);
  for (const auto* wall : walls)
    if (in_plane(*wall, plane, touch_m)) open = clip_difference(open, projected(*wall, plane));
  return without_slivers(std::move(open), 2.0 * touch_m).empty();
}

bool is_pierced(const ConvexBody& body, const std::vector<const Polygon*>& walls, double touch_m) {
  return std::any_of(walls.begin(), walls.end(), [&](const Polygon* wall) { return pierces(*wall, body, touch_m); });
}

/// Whether a face of a box remains that does not lie against a wall.
bool is_seen(const ConvexBody& body, const std::vector<Surface>& surfaces, double touch_m) {
  if (body.flat()) return true;
  const auto lies_against = [&](const Ring3& face, const Surface& wall) {
    return wall.bounding && std::all_of(face.begin(), face.end(), [&](const Vec3& p) {
             return std::abs(wall.polygon.frame().height(p)) <= touch_m;
           });
  };
  return std::any_of(body.faces.begin(), body.faces.end(), [&](const Ring3& face) {
    return std::none_of(surfaces.begin(), surfaces.end(),
                        [&](const Surface& wall) { return lies_against(face, wall); });
  });
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

std::string name_of_end(const std::vector<Surface>& surfaces, const std::string& first_face) {
  for (int i = 1;; ++i) {
    const std::string name = first_face + (i == 1 ? ".end" : ".end" + std::to_string(i));
    if (std::none_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) { return s.name == name; })) return name;
  }
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
  face.name = name_of_end(surfaces, face.name);
  face.polygon = Polygon(end);
  surfaces.push_back(std::move(face));
  links.push_back({"", {}, true});
}

}  // namespace

bool goes_through_shell(const std::vector<Surface>& surfaces, const BodyFaces& body, double touch_m) {
  return !walls_through(surfaces, shape_of(surfaces, body), 10.0 * touch_m).empty();
}

// Exact, since body and parts are convex: a part that no wall pierces lies on one side of the shell as a whole.
std::vector<ShellCut> find_shell_cuts(const std::vector<Surface>& surfaces, const BodyFaces& body,
                                      const InsideTest& test, double touch_m) {
  const ConvexBody whole = shape_of(surfaces, body);
  const auto walls = walls_through(surfaces, whole, touch_m);
  const auto planes = planes_of(walls, touch_m);
  ConvexBody inside = whole;
  for (const auto& plane : planes) inside = front_of(inside, plane, touch_m);
  if (planes.empty() || !is_seen(inside, surfaces, touch_m) || is_pierced(inside, walls, touch_m) ||
      test.outside(middle_of(inside)))
    return {};
  std::vector<ShellCut> cuts;
  for (const auto& plane : planes) {
    const ConvexBody behind = front_of(whole, turned(plane), touch_m);
    if (is_pierced(behind, walls, touch_m) || !test.outside(middle_of(behind))) return {};
    ConvexBody up_to_wall = whole;
    for (const auto& other : planes)
      if (&other != &plane) up_to_wall = front_of(up_to_wall, other, touch_m);
    Ring3 end = section(up_to_wall, plane, touch_m);
    if (!is_covered(end, plane, walls, touch_m)) return {};
    std::reverse(end.begin(), end.end());
    cuts.push_back({body, plane, std::move(end)});
  }
  return cuts;
}

void cut_at_shell(std::vector<Surface>& surfaces, std::vector<SurfaceLink>& links, const std::vector<ShellCut>& cuts,
                  double touch_m) {
  for (const auto& cut : cuts) {
    for (const std::size_t i : surfaces_of(surfaces, cut.body)) clip_behind(surfaces[i].polygon, cut.plane, touch_m);
    if (cut.body.n > 1 && is_wide(cut.end, touch_m)) close_box(surfaces, links, cut.body, cut.end);
  }
}

}  // namespace dim
