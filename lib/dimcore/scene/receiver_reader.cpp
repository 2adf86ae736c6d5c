#include "scene/receiver_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "database/toml_reader.hpp"
#include "scene/face_source.hpp"
#include "scene/outline_check.hpp"
#include "scene/point_quantity.hpp"

namespace dim {
namespace {

constexpr int kMaxPixels = 32768;

class UniqueNames {
 public:
  void add(const TomlTable& table, const std::string& name, const std::vector<Facing>& facings) {
    for (const Facing& facing : facings) add(table, name + facing.suffix);
  }
  void add(const TomlTable& table, const std::string& name) {
    const auto [it, added] = lines_.emplace(name, table.place("name").line);
    if (!added)
      table.problem("name", fmt::format("the name '{}' is used twice, first at line {}", name, it->second));
  }

 private:
  std::map<std::string, int> lines_;
};

int divisions(double size, double spacing) {
  constexpr double kRounding = 1e-9;  // 6.2 / 0.1 is 62 squares, not 63
  const double n = std::ceil(size / spacing * (1.0 - kRounding));
  return n < 1.0 ? 1 : n > kMaxGrid ? kMaxGrid + 1 : static_cast<int>(n);
}

void lay_out_points(const MeasuringPlane& plane, const Response& response, std::vector<MeasuringPoint>& points) {
  const Vec2 size = plane.polygon.size_m();
  for (int j = 0; j < plane.nv; ++j) {
    for (int i = 0; i < plane.nu; ++i) {
      const Vec2 middle(size.x * (i + 0.5) / plane.nu, size.y * (j + 0.5) / plane.nv);
      if (plane.polygon.contains(middle))
        points.push_back({plane.polygon.frame().to_world(middle), response.normal, true, response.quantity});
    }
  }
}

bool set_grid(const TomlTable& table, const ZoneFrame& frame, double cell_m, MeasuringPlane& plane) {
  const auto spacing = table.number("spacing", kLength);
  const auto grid = table.integers2("grid", 1, kMaxGrid);
  if (grid) {
    plane.nu = grid->first;
    plane.nv = grid->second;
    if (spacing) table.problem("spacing", "both spacing and grid are given", "leave one out");
    return true;
  }
  const double step_m = spacing ? *spacing * frame.unit_m : cell_m;
  plane.nu = divisions(plane.polygon.size_m().x, step_m);
  plane.nv = divisions(plane.polygon.size_m().y, step_m);
  if (plane.nu <= kMaxGrid && plane.nv <= kMaxGrid) return true;
  table.problem("spacing", fmt::format("more than {} points along one side", kMaxGrid),
                "give a larger spacing");
  return false;
}

// What the points of a plane measure.
std::vector<Facing> plane_facings(const TomlTable& table, const Vec3& normal) {
  const PointQuantity quantity(table);
  const auto direction = table.vec3("direction");
  if (direction && !quantity.takes_direction())
    table.problem("direction", "only semicylindrical and vertical4 have a direction", "leave it out");
  if (direction && !(glm::length(*direction) > 0.0)) {
    table.problem("direction", "direction has zero length");
    return {};
  }
  std::string fault;
  const bool upright = quantity.quantity() == Quantity::cylindrical;
  auto facings = quantity.facings(upright ? Vec3(0, 0, 1) : direction ? glm::normalize(*direction) : normal, fault);
  if (!fault.empty())
    table.problem(direction ? "direction" : "quantity", fault, "write a level one: direction = [1, 0, 0]");
  return facings;
}

void read_plane(const TomlTable& table, const ZoneFrame& frame, double cell_m, UniqueNames& names,
                Zone& zone) {
  const bool complete = int(table.require("name")) & int(table.require("vertices"));
  const auto name = table.name();
  auto outline = table.ring("vertices");
  auto holes = table.rings("holes");
  MeasuringPlane plane;
  bool valid = complete && name && outline;
  if (valid) {
    for (auto& p : *outline) p = frame.to_zone(p);
    if (!holes) holes.emplace();
    for (auto& hole : *holes)
      for (auto& p : hole) p = frame.to_zone(p);
    valid = check_outline(*outline, *holes, table.label(), table.place("vertices"), table.context().problems);
  }
  if (!valid) {
    for (const char* key : {"spacing", "grid", "quantity", "direction"}) table.has(key);
    return table.refuse_unknown();
  }
  plane.name = *name;
  plane.polygon = Polygon(*outline, *holes);
  plane.place = table.place("name");
  const bool laid = set_grid(table, frame, cell_m, plane);
  const auto facings = plane_facings(table, plane.polygon.normal());
  names.add(table, *name, facings);
  table.refuse_unknown();
  if (!laid) return;
  const auto n = static_cast<std::size_t>(plane.nu) * static_cast<std::size_t>(plane.nv);
  if (n > kMaxPoints)
    return table.problem("name", fmt::format("{} points, at most {} are accepted", n, kMaxPoints),
                         "give a larger spacing");
  for (const Facing& facing : facings) {
    plane.name = *name + facing.suffix;
    const std::size_t first = zone.points.size();
    lay_out_points(plane, facing.response, zone.points);
    zone.point_sets.push_back({plane.name, first, zone.points.size() - first, plane.place});
    zone.planes.push_back(plane);
  }
  if (!facings.empty() && zone.point_sets.back().count == 0)
    table.problem("name", "no point of its grid lies inside it", "give a finer spacing or grid");
}

void read_sensors(const TomlTable& table, const ZoneFrame& frame, UniqueNames& names, Zone& zone) {
  const bool complete = int(table.require("name")) & int(table.require("points"));
  const auto name = table.name();
  const auto rows = table.rows("points", 6, kCoordinate);
  const PointQuantity quantity(table);
  table.refuse_unknown();
  if (!complete || !name || !rows) return;
  if (rows->empty()) return table.problem("points", "points is empty");
  const auto refuse = [&](std::size_t i, const std::string& what, const std::string& cure) {
    const auto& row = (*table.node("points")->as_array())[i];
    table.context().problems.add(place_of(row.source(), table.context().file),
                                 fmt::format("{}: point {} {}", table.label(), i + 1, what), cure);
  };
  std::vector<std::vector<MeasuringPoint>> sets;
  std::vector<Facing> facings;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const auto& r = (*rows)[i];
    const Vec3 normal(r[3], r[4], r[5]);
    const double length = glm::length(normal);
    if (!(length > 1e-12)) {
      refuse(i, "has a normal of zero length", "write x y z nx ny nz");
      continue;
    }
    std::string fault;
    facings = quantity.facings(normal / length, fault);
    if (!fault.empty())
      refuse(i, "has a normal that does not fit: " + fault,
             quantity.takes_direction() ? "write nz = 0" : "write nx ny nz = 0 0 1");
    sets.resize(facings.size());
    for (std::size_t k = 0; k < facings.size(); ++k)
      sets[k].push_back({frame.to_zone({r[0], r[1], r[2]}), facings[k].response.normal, true, facings[k].response.quantity});
  }
  names.add(table, *name, facings);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    zone.point_sets.push_back({*name + facings[k].suffix, zone.points.size(), sets[k].size(), table.place("name")});
    zone.points.insert(zone.points.end(), sets[k].begin(), sets[k].end());
  }
}

// Corners of the surfaces' bounding box, what stands outside left out.
std::vector<Vec3> box_of(const Zone& zone) {
  std::vector<Vec3> corners;
  for (const auto& surface : zone.surfaces)
    for (const auto& ring : surface.polygon.corners())
      if (!surface.outside) corners.insert(corners.end(), ring.begin(), ring.end());
  if (corners.empty()) return corners;
  Vec3 low = corners.front(), high = low;
  for (const auto& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
  corners.clear();
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
  return corners;
}

// What a kind of view has no use for is refused, so that nobody waits for its effect.
void read_kind(const TomlTable& table, View& view) {
  const auto kind = table.word("kind", view_kind_words());
  const auto& words = view_kind_words();
  if (kind) view.kind = static_cast<ViewKind>(std::find(words.begin(), words.end(), *kind) - words.begin());
  constexpr double kDefaultFov_deg = 70.0;
  view.fov_rad = radians(table.number_or("fov", {0.0, 180.0, true, true}, kDefaultFov_deg));
  const bool has_fov = table.has("fov"), has_width = table.has("width");
  if (!kind && table.has("kind")) return;
  if (view.kind != ViewKind::perspective && has_fov)
    table.problem("fov", fmt::format("a view of kind {} has no fov", *kind),
                  view.parallel() ? "give its width, or leave it out" : "leave it out: it shows 180 degrees");
  if (!view.parallel() && has_width)
    table.problem("width", "only plans and elevations have a width", "give fov, or leave it out");
}

void read_size(const TomlTable& table, View& view) {
  constexpr int kRoundSide_px = 1024;
  if (view.round()) view.width = view.height = kRoundSide_px;
  const auto size = table.integers2("size", 1, kMaxPixels);
  if (!size) return;
  std::tie(view.width, view.height) = *size;
  if (view.round() && view.width != view.height)
    table.problem("size", "a round picture is square", fmt::format("write size = [{0}, {0}]", std::min(view.width, view.height)));
}

// A plan and an elevation are to scale: they look along an axis of the room's heights, or across it.
void check_level(const TomlTable& table, const View& view) {
  constexpr double kStraight = 1e-6;
  const Vec3 along = glm::normalize(view.focus - view.eye);
  if (view.kind == ViewKind::plan && std::hypot(along.x, along.y) > kStraight)
    table.problem("focus", "a plan looks straight down or up", "give focus the x and y of eye");
  if (view.kind == ViewKind::elevation && std::abs(along.z) > kStraight)
    table.problem("focus", "an elevation looks level", "give focus the height of eye");
}

void check_view(const TomlTable& table, bool own_up, View& view) {
  const Vec3 along = view.focus - view.eye;
  const double distance = glm::length(along);
  if (!(distance > 0.0)) return table.problem("focus", "focus and eye are the same point");
  constexpr double kParallel = 1e-9;
  if (glm::length(glm::cross(along / distance, view.up)) > kParallel) return;
  if (own_up) return table.problem("up", "up is parallel to the direction of view");
  view.up = {0, 1, 0};  // straight up or down: the top of the picture is +y, as on a plan
}

void read_view(const TomlTable& table, const ZoneFrame& frame, UniqueNames& names, Zone& zone) {
  View view;
  const bool complete = int(table.require("name")) & int(table.require("eye")) & int(table.require("focus"));
  const auto name = table.name();
  const auto eye = table.vec3("eye");
  const auto focus = table.vec3("focus");
  const auto up = table.vec3("up");
  read_kind(table, view);
  read_size(table, view);
  const auto width = table.number("width", kLength);
  table.refuse_unknown();
  if (!complete || !name || !eye || !focus) return;
  names.add(table, *name);
  view.name = *name;
  view.eye = frame.to_zone(*eye);
  view.focus = frame.to_zone(*focus);
  if (up) {
    if (!(glm::length(*up) > 0.0)) return table.problem("up", "up has zero length");
    view.up = glm::normalize(*up);
  }
  check_view(table, up.has_value(), view);
  if (view.focus == view.eye) return;
  if (view.parallel()) {
    check_level(table, view);
    view.width_m = width ? *width * frame.unit_m : fitting_width_m(view, box_of(zone));
  }
  zone.views.push_back(std::move(view));
}

void read_site(const TomlTable& root, const ZoneFrame& frame, Zone& zone) {
  const auto table = root.table("site", "site");
  if (!table) return;
  Site site;
  table->require("latitude");
  site.latitude_deg = table->number_or("latitude", {-90.0, 90.0}, 0.0);
  site.longitude_deg = table->number_or("longitude", {-180.0, 180.0}, 0.0);
  site.time_zone_h = table->number_or("time_zone", {-14.0, 14.0}, std::round(site.longitude_deg / 15.0));
  site.north_deg = table->number_or("north", {-360.0, 360.0}, 0.0);
  if (const auto level = table->number("ground_level", kCoordinate))
    site.ground_m = frame.to_zone({0.0, 0.0, *level}).z;
  table->refuse_unknown();
  zone.site = site;
}

}  // namespace

void read_receivers(const TomlTable& root, const ZoneFrame& frame, double cell_m, Zone& zone) {
  UniqueNames point_sets, views;
  for (const auto& table : root.tables("plane")) read_plane(table, frame, cell_m, point_sets, zone);
  for (const auto& table : root.tables("sensors")) read_sensors(table, frame, point_sets, zone);
  for (const auto& table : root.tables("view")) read_view(table, frame, views, zone);
  read_site(root, frame, zone);
}

}  // namespace dim
