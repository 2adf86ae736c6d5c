#include "scene/plane_reader.hpp"

#include "scene/face_source.hpp"
#include "scene/outline_check.hpp"
#include "scene/point_grid.hpp"
#include "scene/task_area.hpp"

namespace dim {
namespace {

// The polygon of a plane or area; nothing where it is wrong, which is reported.
std::optional<Polygon> read_polygon(const TomlTable& table, const ZoneFrame& frame) {
  auto outline = table.ring("vertices");
  auto holes = table.rings("holes");
  if (!outline) return std::nullopt;
  if (!holes) holes.emplace();
  for (auto& p : *outline) p = frame.to_zone(p);
  for (auto& hole : *holes)
    for (auto& p : hole) p = frame.to_zone(p);
  if (!check_outline(*outline, *holes, table.label(), table.place("vertices"), table.context().problems))
    return std::nullopt;
  return Polygon(*outline, *holes);
}

// @param otherwise_m  spacing where none is given
bool read_grid(const TomlTable& table, const ZoneFrame& frame, double otherwise_m, MeasuringPlane& plane) {
  const auto* node = table.node("spacing");
  const bool is_word = node && node->is_string();
  const bool standard = is_word && table.word("spacing", {"en12464"});
  const auto spacing = is_word ? std::nullopt : table.number("spacing", kLength);
  const auto grid = table.integers2("grid", 1, kMaxGrid);
  if (grid) {
    plane.nu = grid->first;
    plane.nv = grid->second;
    if (spacing || standard) table.problem("spacing", "both spacing and grid are given", "leave one out");
    return true;
  }
  const double step_m = standard ? spacing_en12464_m(plane.polygon.size_m())
                        : spacing ? *spacing * frame.unit_m
                                  : otherwise_m;
  return divide(table, "spacing", step_m, plane);
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

// A band of an area, with points as close as its width has them.
void add_band(const TomlTable& table, const TaskArea::Band& band, const MeasuringPlane& task, Zone& zone) {
  if (band.polygon.rings().empty()) return;
  MeasuringPlane plane{task.name + "." + band.suffix, band.polygon, 1, 1, task.place};
  if (divide(table, band.suffix, spacing_en12464_m({band.width_m, 2.0 * band.width_m}), plane))
    add_plane(table, std::move(plane), {{"", {plane.polygon.normal()}}}, zone);
}

}  // namespace

void read_plane(const TomlTable& table, const ZoneFrame& frame, double cell_m, SetNames& names, Zone& zone) {
  const bool complete = int(table.require("name")) & int(table.require("vertices"));
  const auto name = table.name();
  const auto polygon = read_polygon(table, frame);
  if (!complete || !name || !polygon) {
    for (const char* key : {"spacing", "grid", "quantity", "direction"}) table.has(key);
    return table.refuse_unknown();
  }
  MeasuringPlane plane{*name, *polygon, 1, 1, table.place("name")};
  const bool laid = read_grid(table, frame, cell_m, plane);
  const auto facings = plane_facings(table, plane.polygon.normal());
  names.add(table, *name, facings);
  table.refuse_unknown();
  if (laid) add_plane(table, std::move(plane), facings, zone);
}

void read_area(const TomlTable& table, const ZoneFrame& frame, SetNames& names, Zone& zone) {
  constexpr double kSurrounding_m = 0.5, kBackground_m = 3.0;
  constexpr NumberRange kWidth{0.0, kMaxCoordinate};
  const bool complete = int(table.require("name")) & int(table.require("vertices"));
  const auto name = table.name();
  const auto polygon = read_polygon(table, frame);
  const double surrounding_m = table.number_or("surrounding", kWidth, kSurrounding_m / frame.unit_m) * frame.unit_m;
  const double background_m = table.number_or("background", kWidth, kBackground_m / frame.unit_m) * frame.unit_m;
  if (!complete || !name || !polygon) {
    for (const char* key : {"spacing", "grid"}) table.has(key);
    return table.refuse_unknown();
  }
  MeasuringPlane task{*name, *polygon, 1, 1, table.place("name")};
  const bool laid = read_grid(table, frame, spacing_en12464_m(polygon->size_m()), task);
  table.refuse_unknown();
  constexpr double kLevel = 1.0 - 1e-9;
  if (!(polygon->normal().z > kLevel))
    return table.problem("vertices", "a task area is level and looks up",
                         "write its corners counter-clockwise as seen from above, all of one height");
  if (!laid) return;
  const TaskArea area(*polygon, surrounding_m, background_m, zone);
  for (const char* suffix : {"", ".surrounding", ".background"}) names.add(table, *name + suffix);
  add_plane(table, task, {{"", {polygon->normal()}}}, zone);
  for (const auto& band : area.bands()) add_band(table, band, task, zone);
}

}  // namespace dim
