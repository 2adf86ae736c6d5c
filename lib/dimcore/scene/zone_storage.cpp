#include "scene/zone_storage.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dim {
namespace {

using Json = nlohmann::json;

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

std::vector<Polygon> load_polygons(const Hdf5Reader& file, const std::string& group) {
  const auto frames = file.dataset<double>(group + "frame", {kAnySize, 4, 3});
  const auto n_rings = file.dataset<std::uint32_t>(group + "n_rings", {frames.size() / 12});
  const auto n_corners = file.dataset<std::uint32_t>(group + "n_corners", {kAnySize});
  const auto local = file.dataset<double>(group + "corner_uv", {kAnySize, 2});
  std::vector<Polygon> polygons;
  std::size_t ring_at = 0, corner_at = 0;
  for (std::size_t i = 0; i < n_rings.size(); ++i) {
    const auto axis = [&](std::size_t k) {
      return Vec3(frames[i * 12 + k * 3], frames[i * 12 + k * 3 + 1], frames[i * 12 + k * 3 + 2]);
    };
    std::vector<Ring2> rings;
    for (std::uint32_t r = 0; r < n_rings[i]; ++r, ++ring_at) {
      const std::size_t n = n_corners.at(ring_at);
      if (n < 3) throw std::out_of_range("ring");
      Ring2 ring;
      for (std::size_t c = 0; c < n; ++c, ++corner_at)
        ring.push_back({local.at(2 * corner_at), local.at(2 * corner_at + 1)});
      rings.push_back(std::move(ring));
    }
    if (rings.empty()) throw std::out_of_range("polygon");
    polygons.emplace_back(Frame{axis(0), axis(1), axis(2), axis(3)}, std::move(rings));
    if (!(polygons.back().area_m2() > 0.0) || !is_finite(axis(0))) throw std::out_of_range("polygon");
  }
  return polygons;
}

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec3(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }
Json to_json(const SpectralCurve& curve) { return curve.points(); }
SpectralCurve curve(const Json& json) {
  auto points = json.get<std::vector<std::pair<double, double>>>();
  const auto not_after = [](const auto& a, const auto& b) { return !(a.first < b.first); };
  if (points.empty() || std::adjacent_find(points.begin(), points.end(), not_after) != points.end())
    throw std::out_of_range("curve");
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
               {"angular_law", finish.angular_law},
               {"source", finish.source}};
  if (finish.extinction) json["extinction"] = to_json(*finish.extinction);
  if (finish.specular_reflectance) json["specular_reflectance"] = to_json(*finish.specular_reflectance);
  return json;
}

Finish finish_from_json(const Json& json) {
  Finish finish;
  finish.name = json.at("name");
  finish.kind = json.at("kind") == "glazing" ? FinishKind::glazing : FinishKind::opaque;
  finish.diffuse = curve(json.at("diffuse"));
  finish.specular = json.at("specular");
  finish.roughness = json.at("roughness");
  finish.ior = curve(json.at("ior"));
  finish.distribution = json.at("distribution");
  finish.transmittance = curve(json.at("transmittance"));
  finish.angular_law = json.value("angular_law", finish.angular_law);
  finish.angular_law = json.at("angular_law");
  finish.source = json.at("source");
  if (json.contains("extinction")) finish.extinction = curve(json["extinction"]);
  if (json.contains("specular_reflectance"))
    finish.specular_reflectance = curve(json["specular_reflectance"]);
  return finish;
}

Json description(const Zone& zone) {
  Json json = {{"name", zone.name},
               {"finishes", Json::array()},
               {"views", Json::array()},
               {"planes", Json::array()},
               {"point_sets", Json::array()}};
  for (const auto& finish : zone.finishes) json["finishes"].push_back(finish_to_json(finish));
  for (const auto& view : zone.views)
    json["views"].push_back({{"name", view.name},
                             {"eye", to_json(view.eye)},
                             {"focus", to_json(view.focus)},
                             {"up", to_json(view.up)},
                             {"fov_rad", view.fov_rad},
                             {"size", {view.width, view.height}}});
  for (const auto& plane : zone.planes)
    json["planes"].push_back({{"name", plane.name}, {"nu", plane.nu}, {"nv", plane.nv}});
  for (const auto& set : zone.point_sets)
    json["point_sets"].push_back({{"name", set.name}, {"first", set.first}, {"count", set.count}});
  if (zone.site)
    json["site"] = {{"latitude_deg", zone.site->latitude_deg},
                    {"longitude_deg", zone.site->longitude_deg},
                    {"time_zone_h", zone.site->time_zone_h},
                    {"north_deg", zone.site->north_deg}};
  return json;
}

void read_description(const Json& json, Zone& zone, const std::vector<Polygon>& plane_polygons) {
  zone.name = json.at("name");
  for (const auto& finish : json.at("finishes")) zone.finishes.push_back(finish_from_json(finish));
  for (const auto& v : json.at("views")) {
    View view{v.at("name"), vec3(v.at("eye")), vec3(v.at("focus")), vec3(v.at("up")), v.at("fov_rad")};
    view.width = v.at("size").at(0);
    view.height = v.at("size").at(1);
    zone.views.push_back(std::move(view));
  }
  for (std::size_t i = 0; i < json.at("planes").size(); ++i) {
    const auto& p = json["planes"][i];
    zone.planes.push_back({p.at("name"), plane_polygons.at(i), p.at("nu"), p.at("nv"), {}});
  }
  for (const auto& set : json.at("point_sets"))
    zone.point_sets.push_back({set.at("name"), set.at("first"), set.at("count"), {}});
  if (json.contains("site")) {
    const auto& s = json["site"];
    zone.site = Site{s.at("latitude_deg"), s.at("longitude_deg"), s.at("time_zone_h"), s.at("north_deg")};
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

void load_surfaces(const Hdf5Reader& file, Zone& zone) {
  const auto polygons = load_polygons(file, "/zone/surfaces/");
  const auto names = file.strings("/zone/surfaces/name");
  const auto table = file.dataset<std::int32_t>("/zone/surfaces/table", {polygons.size(), kSurfaceColumns});
  const auto cell_m = file.dataset<double>("/zone/surfaces/cell", {polygons.size()});
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto* row = &table[i * kSurfaceColumns];
    Surface surface;
    surface.name = names.at(i);
    surface.polygon = polygons[i];
    surface.finish = row[0];
    surface.parent = row[1];
    surface.twin = row[2];
    surface.bounding = row[3] != 0;
    surface.outside = row[4] != 0;
    surface.fills_rectangle = row[5] != 0;
    if (row[6] > 0) surface.grid = std::pair(row[6], row[7]);
    surface.cell_m = cell_m[i];
    zone.surfaces.push_back(std::move(surface));
  }
}

void check(const Zone& zone, const std::string& path) {
  const auto within = [](int index, std::size_t n) { return index >= -1 && index < static_cast<int>(n); };
  const bool surfaces_hold =
      std::all_of(zone.surfaces.begin(), zone.surfaces.end(), [&](const Surface& surface) {
        return surface.finish >= 0 && within(surface.finish, zone.finishes.size()) &&
               within(surface.parent, zone.surfaces.size()) && within(surface.twin, zone.surfaces.size()) &&
               (surface.grid ? surface.grid->second > 0 : surface.cell_m > 0.0);
      });
  const bool points_hold = std::all_of(
      zone.points.begin(), zone.points.end(),
      [](const MeasuringPoint& point) { return is_finite(point.position) && is_finite(point.normal); });
  const bool sets_hold =
      std::all_of(zone.point_sets.begin(), zone.point_sets.end(), [&](const PointSet& set) {
        return set.first <= zone.points.size() && set.count <= zone.points.size() - set.first;
      });
  if (!surfaces_hold || !points_hold || !sets_hold)
    throw IoError(path, "the zone in this file does not hold together");
}

}  // namespace

void store_zone(Hdf5Writer& file, const Zone& zone) {
  file.text("/zone/description", description(zone).dump());
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

Zone load_zone(const Hdf5Reader& file, const std::string& path) {
  Zone zone;
  try {
    zone.unit_m = file.number_attribute("/zone", "unit_m");
    zone.diameter_m = file.number_attribute("/zone", "diameter_m");
    zone.volume_m3 = file.number_attribute("/zone", "volume_m3");
    zone.closed = file.integer_attribute("/zone", "closed") != 0;
    const auto origin = file.dataset<double>("/zone/origin", {3});
    zone.origin_m = {origin[0], origin[1], origin[2]};
    load_surfaces(file, zone);
    const auto points = file.dataset<double>("/zone/points", {kAnySize, 6});
    const auto valid = file.dataset<std::uint8_t>("/zone/point_valid", {points.size() / 6});
    for (std::size_t i = 0; i < points.size(); i += 6)
      zone.points.push_back({{points[i], points[i + 1], points[i + 2]},
                             {points[i + 3], points[i + 4], points[i + 5]},
                             valid[i / 6] != 0});
    read_description(Json::parse(file.text("/zone/description")), zone, load_polygons(file, "/zone/planes/"));
  } catch (const nlohmann::json::exception&) {
    throw IoError(path, "the description of the zone in this file cannot be read");
  } catch (const std::out_of_range&) {
    throw IoError(path, "the zone in this file does not hold together");
  } catch (const InternalError&) {  // a polygon without area
    throw IoError(path, "the zone in this file does not hold together");
  }
  check(zone, path);
  return zone;
}

}  // namespace dim
