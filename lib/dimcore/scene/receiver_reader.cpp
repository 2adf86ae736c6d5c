#include "scene/receiver_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "database/toml_reader.hpp"
#include "scene/face_source.hpp"
#include "scene/outline_check.hpp"

namespace dim {
namespace {

constexpr int kMaxPixels = 32768;

class UniqueNames {
 public:
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

void lay_out_points(const MeasuringPlane& plane, std::vector<MeasuringPoint>& points) {
  const Vec2 size = plane.polygon.size_m();
  for (int j = 0; j < plane.nv; ++j) {
    for (int i = 0; i < plane.nu; ++i) {
      const Vec2 middle(size.x * (i + 0.5) / plane.nu, size.y * (j + 0.5) / plane.nv);
      if (plane.polygon.contains(middle))
        points.push_back({plane.polygon.frame().to_world(middle), plane.polygon.normal()});
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

void read_plane(const TomlTable& table, const ZoneFrame& frame, double cell_m, UniqueNames& names,
                Zone& zone) {
  const bool complete = int(table.require("name")) & int(table.require("vertices"));
  const auto name = table.name();
  auto outline = table.ring("vertices");
  auto holes = table.rings("holes");
  MeasuringPlane plane;
  bool valid = complete && name && outline;
  if (valid) {
    names.add(table, *name);
    for (auto& p : *outline) p = frame.to_zone(p);
    if (!holes) holes.emplace();
    for (auto& hole : *holes)
      for (auto& p : hole) p = frame.to_zone(p);
    valid = check_outline(*outline, *holes, table.label(), table.place("vertices"), table.context().problems);
  }
  if (!valid) {
    for (const char* key : {"spacing", "grid"}) table.has(key);
    return table.refuse_unknown();
  }
  plane.name = *name;
  plane.polygon = Polygon(*outline, *holes);
  plane.place = table.place("name");
  const bool laid = set_grid(table, frame, cell_m, plane);
  table.refuse_unknown();
  if (!laid) return;
  const auto n = static_cast<std::size_t>(plane.nu) * static_cast<std::size_t>(plane.nv);
  if (n > kMaxPoints)
    return table.problem("name", fmt::format("{} points, at most {} are accepted", n, kMaxPoints),
                         "give a larger spacing");
  const std::size_t first = zone.points.size();
  lay_out_points(plane, zone.points);
  const std::size_t count = zone.points.size() - first;
  if (count == 0)
    table.problem("name", "no point of its grid lies inside it", "give a finer spacing or grid");
  zone.point_sets.push_back({plane.name, first, count, plane.place});
  zone.planes.push_back(std::move(plane));
}

void read_sensors(const TomlTable& table, const ZoneFrame& frame, UniqueNames& names, Zone& zone) {
  const bool complete = int(table.require("name")) & int(table.require("points"));
  const auto name = table.name();
  const auto rows = table.rows("points", 6, kCoordinate);
  table.refuse_unknown();
  if (!complete || !name || !rows) return;
  names.add(table, *name);
  if (rows->empty()) return table.problem("points", "points is empty");
  const std::size_t first = zone.points.size();
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const auto& r = (*rows)[i];
    const Vec3 normal(r[3], r[4], r[5]);
    const double length = glm::length(normal);
    if (!(length > 1e-12)) {
      const auto& row = (*table.node("points")->as_array())[i];
      table.context().problems.add(
          place_of(row.source(), table.context().file),
          fmt::format("{}: point {} has a normal of zero length", table.label(), i + 1),
          "write x y z nx ny nz");
      continue;
    }
    zone.points.push_back({frame.to_zone({r[0], r[1], r[2]}), normal / length});
  }
  zone.point_sets.push_back({*name, first, zone.points.size() - first, table.place("name")});
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
  constexpr double kDefaultFov_deg = 70.0;
  view.fov_rad = radians(table.number_or("fov", {0.0, 180.0, true, true}, kDefaultFov_deg));
  if (const auto size = table.integers2("size", 1, kMaxPixels))
    view.width = size->first, view.height = size->second;
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
