#include "scene/receiver_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "database/toml_reader.hpp"
#include "scene/plane_reader.hpp"

namespace dim {
namespace {

constexpr int kMaxPixels = 32768;

void read_sensors(const TomlTable& table, const ZoneFrame& frame, SetNames& names, Zone& zone) {
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

void read_view(const TomlTable& table, const ZoneFrame& frame, SetNames& names, Zone& zone) {
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
  SetNames point_sets, views;
  for (const auto& table : root.tables("plane")) read_plane(table, frame, cell_m, point_sets, zone);
  for (const auto& table : root.tables("area")) read_area(table, frame, point_sets, zone);
  for (const auto& table : root.tables("sensors")) read_sensors(table, frame, point_sets, zone);
  for (const auto& table : root.tables("view")) read_view(table, frame, views, zone);
  read_site(root, frame, zone);
}

}  // namespace dim
