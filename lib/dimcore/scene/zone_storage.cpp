#include "scene/zone_storage.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_entry.hpp"
#include "reflection/klems.hpp"

namespace dim {
namespace {

using Json = nlohmann::json;

const std::string kDescription = "/zone/description";
constexpr int kMostPixels = 32768;  // of a side of a picture

// Polygons packed one after the other: frames, rings per polygon, corners per ring.
struct PackedPolygons {
  std::vector<double> frame;             // [n, 4, 3] origin, u, v, n
  std::vector<std::uint32_t> n_rings;    // [n]
  std::vector<std::uint32_t> n_corners;  // [rings]
  std::vector<double> local_m;           // [corners, 2]
  std::vector<double> vertex_m;          // [corners, 3] in the user's coordinates

  void add(const Polygon& polygon, const Vec3& origin_m) {
    const Frame& f = polygon.frame();
    for (const Vec3& v : {f.origin, f.u, f.v, f.n}) frame.insert(frame.end(), {v.x, v.y, v.z});
    n_rings.push_back(static_cast<std::uint32_t>(polygon.rings().size()));
    for (const auto& ring : polygon.rings()) {
      n_corners.push_back(static_cast<std::uint32_t>(ring.size()));
      for (const auto& p : ring) {
        const Vec3 world = f.to_world(p) + origin_m;
        local_m.insert(local_m.end(), {p.x, p.y});
        vertex_m.insert(vertex_m.end(), {world.x, world.y, world.z});
      }
    }
  }
};

void store_polygons(Hdf5Writer& file, const std::string& group, const PackedPolygons& packed) {
  const auto store = [&](const std::string& name, const auto& values, const Shape& shape,
                         const std::string& unit, const std::string& what) {
    file.dataset(group + name, std::span(values), shape, unit, what);
  };
  store("frame", packed.frame, {packed.n_rings.size(), 4, 3}, "m", "origin, u, v, normal; zone-centred");
  store("n_rings", packed.n_rings, {packed.n_rings.size()}, "1", "rings of each polygon, holes clockwise");
  store("n_corners", packed.n_corners, {packed.n_corners.size()}, "1", "corners of each ring");
  store("corner_uv", packed.local_m, {packed.local_m.size() / 2, 2}, "m", "corners in the polygon's frame");
  store("vertex", packed.vertex_m, {packed.vertex_m.size() / 3, 3}, "m", "corners in the zone file's axes");
}

// Light is carried by dot products with these: unit axes, right-handed.
void check_frame(const Frame& frame, const std::string& dataset, std::size_t i, const std::string& path) {
  constexpr double kRounding = 1e-9;
  const bool good = std::abs(glm::dot(frame.u, frame.u) - 1.0) <= kRounding &&
                    std::abs(glm::dot(frame.v, frame.v) - 1.0) <= kRounding &&
                    std::abs(glm::dot(frame.u, frame.v)) <= kRounding &&
                    glm::length(frame.n - glm::cross(frame.u, frame.v)) <= kRounding;
  if (!good)
    throw IoError(path, fmt::format("dataset '{}': the axes of polygon {} are not unit vectors with n = u x v",
                                    dataset, i));
}

// Cuts one list of the file, by counts, into another's elements.
class Reel {
 public:
  Reel(const std::string& dataset, std::size_t n, const std::string& path)
      : dataset_(dataset), n_(n), path_(path) {}
  std::size_t next(std::size_t count) {
    if (count > n_ - at_)
      throw IoError(path_, fmt::format("dataset '{}' has {} elements, others ask for more", dataset_, n_));
    return std::exchange(at_, at_ + count);
  }
  void finish() const {
    if (at_ != n_)
      throw IoError(path_, fmt::format("dataset '{}' has {} elements, others ask for {}", dataset_, n_, at_));
  }

 private:
  std::string dataset_;
  std::size_t n_, at_ = 0;
  const std::string& path_;
};

std::vector<Polygon> load_polygons(const Hdf5Reader& file, const std::string& group, const std::string& path) {
  const auto frames = file.dataset<double>(group + "frame", {kAnySize, 4, 3});
  const auto n_rings = file.dataset<std::uint32_t>(group + "n_rings", {frames.size() / 12});
  const auto n_corners = file.dataset<std::uint32_t>(group + "n_corners", {kAnySize});
  const auto local = file.dataset<double>(group + "corner_uv", {kAnySize, 2});
  Reel rings_left(group + "n_corners", n_corners.size(), path),
      corners_left(group + "corner_uv", local.size() / 2, path);
  std::vector<Polygon> polygons;
  for (std::size_t i = 0; i < n_rings.size(); ++i) {
    const auto axis = [&](std::size_t k) {
      return Vec3(frames[i * 12 + k * 3], frames[i * 12 + k * 3 + 1], frames[i * 12 + k * 3 + 2]);
    };
    const Frame frame{axis(0), axis(1), axis(2), axis(3)};
    check_frame(frame, group + "frame", i, path);
    std::vector<Ring2> rings;
    const std::size_t first_ring = rings_left.next(n_rings[i]);
    for (std::size_t r = first_ring; r < first_ring + n_rings[i]; ++r) {
      if (n_corners[r] < 3)
        throw IoError(path, fmt::format("dataset '{}n_corners': element {} is {}, a ring has at least 3", group,
                                        r, n_corners[r]));
      Ring2 ring;
      const std::size_t first = corners_left.next(n_corners[r]);
      for (std::size_t c = first; c < first + n_corners[r]; ++c) ring.push_back({local[2 * c], local[2 * c + 1]});
      rings.push_back(std::move(ring));
    }
    try {
      polygons.emplace_back(frame, std::move(rings));
    } catch (const InternalError&) {
      throw IoError(path, fmt::format("dataset '{}corner_uv': polygon {} has no area", group, i));
    }
  }
  rings_left.finish();
  corners_left.finish();
  return polygons;
}

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Json to_json(const SpectralCurve& curve) { return curve.points(); }

SpectralCurve curve(const JsonEntry& json, double low, double high) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < json.size(); ++i) {
    json.at(i).size(2);
    points.emplace_back(json.at(i).at(0).number(), json.at(i).at(1).number(low, high));
    if (i > 0 && !(points[i - 1].first < points[i].first)) json.at(i).fail("is not in order of wavelength");
  }
  if (points.empty()) json.fail("has no point");
  return SpectralCurve(std::move(points));
}

Json finish_to_json(const Finish& finish) {
  Json json = {{"name", finish.name},
               {"kind", finish.kind == FinishKind::glazing ? "glazing" : "opaque"},
               {"diffuse", to_json(finish.diffuse)},
               {"specular", finish.specular},
               {"roughness", finish.roughness},
               {"ior", to_json(finish.ior)},
               {"distribution", finish.distribution},
               {"transmittance", to_json(finish.transmittance)},
               {"angular_law", finish.angular_law},
               {"by_angle", finish.by_angle},
               {"direct", finish.direct},
               {"source", finish.source}};
  if (finish.bsdf) json["bsdf"] = finish.bsdf->values();
  if (finish.extinction) json["extinction"] = to_json(*finish.extinction);
  if (finish.specular_reflectance) json["specular_reflectance"] = to_json(*finish.specular_reflectance);
  return json;
}

std::vector<std::pair<double, double>> angles_from(const JsonEntry& json) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < json.size(); ++i) {
    json.at(i).size(2);
    points.emplace_back(json.at(i).at(0).number(0.0, 90.0), json.at(i).at(1).number(0.0));
    if (i > 0 && !(points[i - 1].first < points[i].first)) json.at(i).fail("is not in order of angle");
  }
  return points;
}

Finish finish_from(const JsonEntry& json) {
  Finish finish;
  finish.name = json["name"].text();
  finish.kind = json["kind"].word({"opaque", "glazing"}) == 0 ? FinishKind::opaque : FinishKind::glazing;
  finish.diffuse = curve(json["diffuse"], 0.0, 1.0);
  finish.specular = json["specular"].number(0.0, 1.0);
  finish.roughness = json["roughness"].number(0.0);
  finish.ior = curve(json["ior"], 0.0, HUGE_VAL);
  json["distribution"].word({"gaussian", "beckmann"});
  finish.distribution = json["distribution"].text();
  finish.transmittance = curve(json["transmittance"], 0.0, 1.0);
  json["angular_law"].word({"glass", "constant", "table", "diffusing", "bsdf"});
  finish.angular_law = json["angular_law"].text();
  if (json.has("by_angle")) finish.by_angle = angles_from(json["by_angle"]);
  if (json.has("direct")) finish.direct = json["direct"].number(0.0, 1.0);
  if (json.has("bsdf"))
    finish.bsdf = std::make_shared<const KlemsMatrix>(json["bsdf"].numbers(klems::kPatches * klems::kPatches, 0.0));
  else if (finish.angular_law == "bsdf")
    json["angular_law"].fail("is bsdf without a 'bsdf' beside it");
  if (finish.angular_law == "table" && finish.by_angle.empty()) json["by_angle"].fail("has no point");
  finish.source = json["source"].text();
  if (json.has("extinction")) finish.extinction = curve(json["extinction"], 0.0, HUGE_VAL);
  if (json.has("specular_reflectance"))
    finish.specular_reflectance = curve(json["specular_reflectance"], 0.0, 1.0);
  return finish;
}

// Of perspectives without the keys of the other kinds: files of a time before these have none either.
Json view_to_json(const View& view) {
  Json json = {{"name", view.name},
               {"eye", to_json(view.eye)},
               {"focus", to_json(view.focus)},
               {"up", to_json(view.up)},
               {"fov_rad", view.fov_rad},
               {"size", {view.width, view.height}}};
  if (view.kind != ViewKind::perspective) json["kind"] = view_kind_words()[static_cast<std::size_t>(view.kind)];
  if (view.parallel()) json["width_m"] = view.width_m;
  return json;
}

Json description(const Zone& zone) {
  Json json = {{"name", zone.name},
               {"finishes", Json::array()},
               {"views", Json::array()},
               {"planes", Json::array()},
               {"point_sets", Json::array()}};
  for (const auto& finish : zone.finishes) json["finishes"].push_back(finish_to_json(finish));
  for (const auto& view : zone.views) json["views"].push_back(view_to_json(view));
  for (const auto& plane : zone.planes)
    json["planes"].push_back({{"name", plane.name}, {"nu", plane.nu}, {"nv", plane.nv}});
  for (const auto& set : zone.point_sets) {
    json["point_sets"].push_back({{"name", set.name}, {"first", set.first}, {"count", set.count}});
    const Quantity quantity = quantity_of(zone, set);
    if (quantity != Quantity::planar) json["point_sets"].back()["quantity"] = quantity_word(quantity);
  }
  if (zone.site)
    json["site"] = {{"latitude_deg", zone.site->latitude_deg},
                    {"longitude_deg", zone.site->longitude_deg},
                    {"time_zone_h", zone.site->time_zone_h},
                    {"north_deg", zone.site->north_deg}};
  if (zone.site && zone.site->ground_m) json["site"]["ground_m"] = *zone.site->ground_m;
  json["windows"] = Json::array();
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    if (zone.surfaces[s].group.empty()) continue;
    Json states = Json::array();
    for (const auto& state : zone.surfaces[s].states) states.push_back({{"name", state.name}, {"finish", state.finish}});
    json["windows"].push_back({{"surface", s}, {"group", zone.surfaces[s].group}, {"states", std::move(states)}});
  }
  return json;
}

// A view that can be drawn: it looks somewhere, and its up is not that way.
View view_from(const JsonEntry& v) {
  View view{v["name"].text(), v["eye"].vec3(), v["focus"].vec3(), v["up"].vec3(), v["fov_rad"].number(0.0, kPi)};
  v["size"].size(2);
  view.width = v["size"].at(0).integer(1, kMostPixels);
  view.height = v["size"].at(1).integer(1, kMostPixels);
  if (!(view.fov_rad > 0.0 && view.fov_rad < kPi)) v["fov_rad"].fail("is not within 0..pi");
  if (!(glm::length(glm::cross(view.focus - view.eye, view.up)) > 0.0))
    v.fail("looks nowhere, or along its own up");
  if (v.has("kind")) view.kind = static_cast<ViewKind>(v["kind"].word(view_kind_words()));
  if (view.parallel()) view.width_m = v["width_m"].positive();
  if (view.round() && view.width != view.height) v["size"].fail("is not square, as round views are");
  return view;
}

// Half cylinders face a level way: their frame is built on it.
void read_quantity(const JsonEntry& word, Zone& zone, const PointSet& set) {
  const auto quantity = static_cast<Quantity>(word.word(quantity_words()));
  for (std::size_t p = set.first; p < set.first + set.count; ++p) {
    zone.points[p].quantity = quantity;
    if (quantity == Quantity::semicylindrical && zone.points[p].normal.z != 0.0)
      word.fail(fmt::format("is semicylindrical, and point {} does not face a level way", p));
  }
}

void read_description(const JsonEntry& json, Zone& zone, const std::vector<Polygon>& plane_polygons) {
  zone.name = json["name"].text();
  const JsonEntry finishes = json["finishes"], views = json["views"], planes = json["planes"],
                  sets = json["point_sets"];
  for (std::size_t i = 0; i < finishes.size(); ++i) zone.finishes.push_back(finish_from(finishes.at(i)));
  for (std::size_t i = 0; i < views.size(); ++i) zone.views.push_back(view_from(views.at(i)));
  for (std::size_t i = 0; i < planes.size(plane_polygons.size()); ++i) {
    constexpr int kMost = std::numeric_limits<int>::max();
    zone.planes.push_back({planes.at(i)["name"].text(), plane_polygons[i], planes.at(i)["nu"].integer(1, kMost),
                           planes.at(i)["nv"].integer(1, kMost), {}});
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const JsonEntry set = sets.at(i);
    const std::size_t first = set["first"].index(zone.points.size() + 1);
    const std::size_t count = set["count"].index(zone.points.size() - first + 1);
    zone.point_sets.push_back({set["name"].text(), first, count, {}});
    if (set.has("quantity")) read_quantity(set["quantity"], zone, zone.point_sets.back());
  }
  if (!json.has("site")) return;
  const JsonEntry site = json["site"];
  zone.site = Site{site["latitude_deg"].number(-90.0, 90.0), site["longitude_deg"].number(),
                   site["time_zone_h"].number(), site["north_deg"].number(), {}};
  if (site.has("ground_m")) zone.site->ground_m = site["ground_m"].number();
}

void read_windows(const JsonEntry& windows, Zone& zone) {
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const JsonEntry window = windows.at(i);
    Surface& surface = zone.surfaces[window["surface"].index(zone.surfaces.size())];
    surface.group = window["group"].text();
    const JsonEntry states = window["states"];
    for (std::size_t k = 0; k < states.size(); ++k)
      surface.states.push_back({states.at(k)["name"].text(),
                                static_cast<int>(states.at(k)["finish"].index(zone.finishes.size()))});
  }
}

// One row a surface: finish, parent, twin, bounding, outside, fills rectangle, grid nu, grid nv (0: none
// asked for).
constexpr std::size_t kSurfaceColumns = 8;

void store_surfaces(Hdf5Writer& file, const Zone& zone) {
  PackedPolygons polygons;
  std::vector<std::int32_t> table;
  std::vector<double> cell_m, area_m2;
  std::vector<std::string> names;
  for (const auto& surface : zone.surfaces) {
    polygons.add(surface.polygon, zone.origin_m);
    const auto grid = surface.grid.value_or(std::pair(0, 0));
    table.insert(table.end(), {surface.finish, surface.parent, surface.twin, surface.bounding,
                               surface.outside, surface.fills_rectangle, grid.first, grid.second});
    cell_m.push_back(surface.cell_m);
    area_m2.push_back(surface.polygon.area_m2());
    names.push_back(surface.name);
  }
  store_polygons(file, "/zone/surfaces/", polygons);
  file.strings("/zone/surfaces/name", names);
  file.dataset("/zone/surfaces/table", std::span<const std::int32_t>(table), {names.size(), kSurfaceColumns},
               "1", "finish, parent, twin, bounding, outside, fills_rectangle, nu, nv; -1 or 0: none");
  file.dataset("/zone/surfaces/cell", std::span<const double>(cell_m), {names.size()}, "m",
               "cell size asked for");
  file.dataset("/zone/surfaces/area", std::span<const double>(area_m2), {names.size()}, "m2");
}

// Entry of a surface's row, within low..high.
int entry(const std::vector<std::int32_t>& table, std::size_t surface, std::size_t column, std::int64_t low,
          std::int64_t high, const std::string& path) {
  const std::int32_t value = table[surface * kSurfaceColumns + column];
  if (value < low || value > high)
    throw IoError(path, fmt::format("dataset '/zone/surfaces/table': [{}, {}] is {}, outside {}..{}", surface,
                                    column, value, low, high));
  return value;
}

void load_surfaces(const Hdf5Reader& file, Zone& zone, const std::string& path) {
  const auto polygons = load_polygons(file, "/zone/surfaces/", path);
  const std::size_t n = polygons.size();
  const auto names = file.strings("/zone/surfaces/name");
  const auto table = file.dataset<std::int32_t>("/zone/surfaces/table", {n, kSurfaceColumns});
  const auto cell_m = file.dataset<double>("/zone/surfaces/cell", {n});
  if (names.size() != n)
    throw IoError(path, fmt::format("dataset '/zone/surfaces/name' has {} elements, expected {}", names.size(), n));
  const auto last_finish = static_cast<std::int64_t>(zone.finishes.size()) - 1,
             last_surface = static_cast<std::int64_t>(n) - 1;
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = [&](std::size_t column, std::int64_t low, std::int64_t high) {
      return entry(table, i, column, low, high, path);
    };
    Surface surface;
    surface.name = names[i];
    surface.polygon = polygons[i];
    surface.finish = at(0, 0, last_finish);
    surface.parent = at(1, -1, last_surface);
    surface.twin = at(2, -1, last_surface);
    surface.bounding = at(3, 0, 1) != 0;
    surface.outside = at(4, 0, 1) != 0;
    surface.fills_rectangle = at(5, 0, 1) != 0;
    if (at(6, 0, kMost) > 0) surface.grid = std::pair(at(6, 1, kMost), at(7, 1, kMost));
    surface.cell_m = cell_m[i];
    if (!surface.grid && !(surface.cell_m > 0.0 && std::isfinite(surface.cell_m)))
      throw IoError(path, fmt::format("dataset '/zone/surfaces/cell': element {} is {:g}, expected more than 0", i,
                                      surface.cell_m));
    zone.surfaces.push_back(std::move(surface));
  }
}

void load_points(const Hdf5Reader& file, Zone& zone, const std::string& path) {
  constexpr double kRounding = 1e-6;
  const auto points = file.dataset<double>("/zone/points", {kAnySize, 6});
  const auto valid = file.dataset<std::uint8_t>("/zone/point_valid", {points.size() / 6});
  for (std::size_t i = 0; i < points.size(); i += 6) {
    const Vec3 at(points[i], points[i + 1], points[i + 2]),
        normal(points[i + 3], points[i + 4], points[i + 5]);
    if (!is_finite(at) || !(std::abs(glm::dot(normal, normal) - 1.0) <= kRounding))
      throw IoError(path, fmt::format("dataset '/zone/points': point {} has no finite place and unit normal", i / 6));
    zone.points.push_back({at, normal, valid[i / 6] != 0});
  }
}

}  // namespace

void store_zone(Hdf5Writer& file, const Zone& zone) {
  file.text(kDescription, dump_json(description(zone)));
  file.attribute("/zone", "unit_m", zone.unit_m);
  file.attribute("/zone", "diameter_m", zone.diameter_m);
  file.attribute("/zone", "volume_m3", zone.volume_m3);
  file.attribute("/zone", "closed", static_cast<int>(zone.closed));
  const std::vector<double> origin{zone.origin_m.x, zone.origin_m.y, zone.origin_m.z};
  file.dataset("/zone/origin", std::span<const double>(origin), {3}, "m",
               "centre of the zone in the zone file's axes");
  store_surfaces(file, zone);
  PackedPolygons planes;
  for (const auto& plane : zone.planes) planes.add(plane.polygon, zone.origin_m);
  store_polygons(file, "/zone/planes/", planes);
  PackedPolygons openings;
  for (const auto& opening : zone.openings) openings.add(opening, zone.origin_m);
  store_polygons(file, "/zone/openings/", openings);
  std::vector<double> points;
  for (const auto& point : zone.points)
    points.insert(points.end(), {point.position.x, point.position.y, point.position.z, point.normal.x,
                                 point.normal.y, point.normal.z});
  file.dataset("/zone/points", std::span<const double>(points), {zone.points.size(), 6}, "m, 1",
               "zone-centred position and normal of the measuring points");
  std::vector<std::uint8_t> valid;
  for (const auto& point : zone.points) valid.push_back(point.valid);
  file.dataset("/zone/point_valid", std::span<const std::uint8_t>(valid), {valid.size()}, "1",
               "0: outside the zone or inside something, left out of statistics");
}

const FileSchema& zone_schema() {
  static const FileSchema schema = [] {
    constexpr double kMost = 1e300;
    FileSchema zone;
    zone.attributes = {{"/zone", "unit_m", AttributeType::number, 1e-12, 1e12},
                       {"/zone", "diameter_m", AttributeType::number, 0.0, kMost},
                       {"/zone", "volume_m3", AttributeType::number, -kMost, kMost},
                       {"/zone", "closed", AttributeType::integer, 0, 1}};
    zone.datasets = {{"/zone/origin", "float64", "3", "m", Allowed::finite},
                     {"/zone/points", "float64", "points, 6", "m, 1", Allowed::finite},
                     {"/zone/point_valid", "uint8", "points", "1", Allowed::flag},
                     {"/zone/description", "text", ""},
                     {"/zone/surfaces/name", "strings", "surfaces"},
                     {"/zone/surfaces/table", "int32", "surfaces, 8"},
                     {"/zone/surfaces/cell", "float64", "surfaces", "m", Allowed::not_negative},
                     {"/zone/surfaces/area", "float64", "surfaces", "m2", Allowed::positive},
                     {"/zone/surfaces/frame", "float64", "surfaces, 4, 3", "m", Allowed::finite},
                     {"/zone/surfaces/n_rings", "uint32", "surfaces", "1", Allowed::positive},
                     {"/zone/surfaces/n_corners", "uint32", "rings"},
                     {"/zone/surfaces/corner_uv", "float64", "corners, 2", "m", Allowed::finite},
                     {"/zone/surfaces/vertex", "float64", "corners, 3", "m", Allowed::finite},
                     {"/zone/planes/frame", "float64", "planes, 4, 3", "m", Allowed::finite},
                     {"/zone/planes/n_rings", "uint32", "planes", "1", Allowed::positive},
                     {"/zone/planes/n_corners", "uint32", "plane_rings"},
                     {"/zone/planes/corner_uv", "float64", "plane_corners, 2", "m", Allowed::finite},
                     {"/zone/planes/vertex", "float64", "plane_corners, 3", "m", Allowed::finite},
                     {"/zone/openings/frame", "float64", "openings, 4, 3", "m", Allowed::finite},
                     {"/zone/openings/n_rings", "uint32", "openings", "1", Allowed::positive},
                     {"/zone/openings/n_corners", "uint32", "opening_rings"},
                     {"/zone/openings/corner_uv", "float64", "opening_corners, 2", "m", Allowed::finite},
                     {"/zone/openings/vertex", "float64", "opening_corners, 3", "m", Allowed::finite}};
    return zone;
  }();
  return schema;
}

Zone load_zone(const Hdf5Reader& file, const std::string& path) {
  Zone zone;
  zone.unit_m = file.number_attribute("/zone", "unit_m");
  zone.diameter_m = file.number_attribute("/zone", "diameter_m");
  zone.volume_m3 = file.number_attribute("/zone", "volume_m3");
  zone.closed = file.integer_attribute("/zone", "closed") != 0;
  const auto origin = file.dataset<double>("/zone/origin", {3});
  zone.origin_m = {origin[0], origin[1], origin[2]};
  const Json json = parse_json(file.text(kDescription), kDescription, path);
  load_points(file, zone, path);
  read_description(JsonEntry(json, kDescription, path), zone, load_polygons(file, "/zone/planes/", path));
  load_surfaces(file, zone, path);
  zone.openings = load_polygons(file, "/zone/openings/", path);
  read_windows(JsonEntry(json, kDescription, path)["windows"], zone);
  return zone;
}

}  // namespace dim
