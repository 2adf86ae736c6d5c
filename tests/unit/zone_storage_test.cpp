// A zone put into a file comes back to the last bit; a forged one is refused.
#include "scene/zone_storage.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "unit/files_support.hpp"
#include "unit/scene_support.hpp"

using namespace dim;
using namespace dim::test;
using files_test::Folder;
using files_test::io_error;

namespace {

Zone stored_and_loaded(const Zone& zone, const std::string& path) {
  Hdf5Writer file("rays", 1);
  store_zone(file, zone);
  std::move(file).write(path);
  return load_zone(Hdf5Reader(path, "rays", 1), path);
}

void check_same(const Polygon& a, const Polygon& b) {
  CHECK(a.rings() == b.rings());
  CHECK(a.frame().origin == b.frame().origin);
  CHECK(a.frame().u == b.frame().u);
  CHECK(a.frame().v == b.frame().v);
  CHECK(a.frame().n == b.frame().n);
  CHECK(a.area_m2() == b.area_m2());
  CHECK(a.is_rectangle() == b.is_rectangle());
  CHECK(a.size_m() == b.size_m());
}

void check_same(const Finish& a, const Finish& b) {
  CHECK(a.name == b.name);
  CHECK(a.kind == b.kind);
  CHECK(a.diffuse.points() == b.diffuse.points());
  CHECK(a.specular == b.specular);
  CHECK(a.roughness == b.roughness);
  CHECK(a.ior.points() == b.ior.points());
  CHECK(a.extinction.has_value() == b.extinction.has_value());
  if (a.extinction && b.extinction) CHECK(a.extinction->points() == b.extinction->points());
  CHECK(a.specular_reflectance.has_value() == b.specular_reflectance.has_value());
  if (a.specular_reflectance && b.specular_reflectance)
    CHECK(a.specular_reflectance->points() == b.specular_reflectance->points());
  CHECK(a.distribution == b.distribution);
  CHECK(a.transmittance.points() == b.transmittance.points());
  CHECK(a.angular_law == b.angular_law);
  CHECK(a.by_angle == b.by_angle);
  CHECK(a.direct == b.direct);
  CHECK(a.source == b.source);
}

void check_same(const Zone& a, const Zone& b) {
  CHECK(a.name == b.name);
  CHECK(a.origin_m == b.origin_m);
  CHECK(a.unit_m == b.unit_m);
  CHECK(a.diameter_m == b.diameter_m);
  CHECK(a.volume_m3 == b.volume_m3);
  CHECK(a.closed == b.closed);
  REQUIRE(a.finishes.size() == b.finishes.size());
  for (std::size_t i = 0; i < a.finishes.size(); ++i) check_same(a.finishes[i], b.finishes[i]);
  REQUIRE(a.surfaces.size() == b.surfaces.size());
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const Surface &s = a.surfaces[i], &t = b.surfaces[i];
    CHECK(s.name == t.name);
    check_same(s.polygon, t.polygon);
    CHECK(s.finish == t.finish);
    CHECK(s.cell_m == t.cell_m);
    CHECK(s.grid == t.grid);
    CHECK(s.parent == t.parent);
    CHECK(s.twin == t.twin);
    CHECK(s.bounding == t.bounding);
    CHECK(s.outside == t.outside);
    CHECK(s.fills_rectangle == t.fills_rectangle);
  }
  REQUIRE(a.planes.size() == b.planes.size());
  for (std::size_t i = 0; i < a.planes.size(); ++i) {
    CHECK(a.planes[i].name == b.planes[i].name);
    check_same(a.planes[i].polygon, b.planes[i].polygon);
    CHECK(a.planes[i].nu == b.planes[i].nu);
    CHECK(a.planes[i].nv == b.planes[i].nv);
  }
  REQUIRE(a.points.size() == b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    CHECK(a.points[i].position == b.points[i].position);
    CHECK(a.points[i].normal == b.points[i].normal);
    CHECK(a.points[i].valid == b.points[i].valid);
  }
  REQUIRE(a.point_sets.size() == b.point_sets.size());
  for (std::size_t i = 0; i < a.point_sets.size(); ++i) {
    CHECK(a.point_sets[i].name == b.point_sets[i].name);
    CHECK(a.point_sets[i].first == b.point_sets[i].first);
    CHECK(a.point_sets[i].count == b.point_sets[i].count);
  }
  REQUIRE(a.views.size() == b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    const View &v = a.views[i], &w = b.views[i];
    CHECK(v.name == w.name);
    CHECK(v.eye == w.eye);
    CHECK(v.focus == w.focus);
    CHECK(v.up == w.up);
    CHECK(v.fov_rad == w.fov_rad);
    CHECK(v.kind == w.kind);
    CHECK(v.width_m == w.width_m);
    CHECK(v.width == w.width);
    CHECK(v.height == w.height);
  }
  REQUIRE(a.site.has_value() == b.site.has_value());
  if (!a.site || !b.site) return;
  CHECK(a.site->latitude_deg == b.site->latitude_deg);
  CHECK(a.site->longitude_deg == b.site->longitude_deg);
  CHECK(a.site->time_zone_h == b.site->time_zone_h);
  CHECK(a.site->north_deg == b.site->north_deg);
}

const std::string kFurnishings = R"(
[[surface]]
name = "picture \"ü\""
finish = "red"
on = "north"
vertices = [[2,4,1],[3,4,1],[3,4,2],[2,4,2]]
grid = [3, 2]
[[surface]]
name = "screen"
finish = "wall"
sides = 2
cell = 0.3
vertices = [[2,1,0.5],[2,2,0.5],[2,2,1.5],[2,1,1.5]]
holes = [[[2,1.2,0.7],[2,1.4,0.7],[2,1.4,0.9],[2,1.2,0.9]]]
[[box]]
name = "desk"
finish = "dark"
corner = [4,1,0]
size = [1.2,0.6,0.7]
turn = 30
[[plane]]
name = "work"
vertices = [[0.5,0.5,0.75],[5.5,0.5,0.75],[5.5,3.5,0.75],[0.5,3.5,0.75]]
grid = [5, 3]
[[sensors]]
name = "eye"
points = [[1.6,1.3,1.2, 0.6,0,0.8]]
[site]
latitude = 55.86
longitude = -4.26
time_zone = 0
north = 12.5
[[view]]
name = "door"
eye = [0.3,0.3,1.6]
focus = [6,4,0.8]
fov = 70
size = [640, 480]
)";

Zone full_zone() {
  std::string text = kRoom + kFurnishings;
  const std::string finishes = "[finishes]\n";
  text.insert(text.find(finishes) + finishes.size(), "red = { diffuse = [[400, 0.05], [700, 0.6]] }\n");
  return test::read(text);
}

// A file like the zone's own, with one dataset replaced or left out.
struct Forgery {
  std::string description;
  std::vector<std::int32_t> table;
  std::vector<std::uint32_t> n_corners, n_rings;
  std::vector<double> points{0, 0, 0, 0, 0, 1};
  std::vector<double> frame{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
};

Forgery honest() {
  Forgery f;
  f.description = R"({"name":"z","finishes":[{"name":"f","kind":"opaque","diffuse":[[555,0.5]],"specular":0.0,
"roughness":0.0,"ior":[[555,1.5]],"distribution":"gaussian","transmittance":[[555,0.0]],"angular_law":"glass",
"by_angle":[],"direct":0.0,"source":"inline"}],"windows":[],"views":[],"planes":[],"point_sets":[{"name":"p","first":0,"count":1}]})";
  f.table = {0, -1, -1, 1, 0, 0, 0, 0};
  f.n_corners = {3};
  f.n_rings = {1};
  return f;
}

std::string refusal(const Forgery& f, const std::string& path) {
  Hdf5Writer file("rays", 1);
  file.text("/zone/description", f.description);
  for (const char* name : {"unit_m", "diameter_m", "volume_m3"}) file.attribute("/zone", name, 1.0);
  file.attribute("/zone", "closed", 1);
  const auto numbers = [&](const std::string& name, const std::vector<double>& v, const Shape& shape) {
    file.dataset("/zone/" + name, std::span<const double>(v), shape, "1");
  };
  numbers("origin", {0, 0, 0}, {3});
  numbers("points", f.points, {f.points.size() / 6, 6});
  const std::vector<std::uint8_t> valid(f.points.size() / 6, 1);
  file.dataset("/zone/point_valid", std::span(valid), {valid.size()}, "1");
  for (const std::string group : {"surfaces", "planes", "openings"}) {
    const bool s = group == "surfaces";
    const std::vector<std::uint32_t> none;
    numbers(group + "/frame",
            s ? f.frame : std::vector<double>{},
            {s ? 1u : 0u, 4, 3});
    const auto& rings = s ? f.n_rings : none;
    const auto& corners = s ? f.n_corners : none;
    file.dataset("/zone/" + group + "/n_rings", std::span<const std::uint32_t>(rings), {rings.size()}, "1");
    file.dataset("/zone/" + group + "/n_corners", std::span<const std::uint32_t>(corners), {corners.size()},
                 "1");
    numbers(group + "/corner_uv", s ? std::vector<double>{0, 0, 1, 0, 0, 1} : std::vector<double>{},
            {s ? 3u : 0u, 2});
  }
  file.strings("/zone/surfaces/name", {"floor"});
  file.dataset("/zone/surfaces/table", std::span<const std::int32_t>(f.table), {1, 8}, "1");
  numbers("surfaces/cell", {0.5}, {1});
  numbers("surfaces/area", {0.5}, {1});
  std::move(file).write(path);
  return io_error([&] { load_zone(Hdf5Reader(path, "rays", 1), path); });
}

}  // namespace

TEST_CASE("A zone with holes, twins, features, planes and views comes back to the last bit",
          "[scene][unit]") {
  const Folder folder;
  const Zone zone = full_zone();
  REQUIRE(zone.surfaces.size() == 6 + 1 + 2 + 5);  // the desk stands on the floor
  check_same(zone, stored_and_loaded(zone, folder / "a.rays"));
}

TEST_CASE("Every property of a finish comes back", "[scene][unit]") {
  const Folder folder;
  Zone zone = box_zone({2, 2, 2}, 0.5, 1.0);
  auto& f = zone.finishes[0];
  f = {"glass", FinishKind::glazing, SpectralCurve(0.08), 0.25, 0.125};
  f.ior = SpectralCurve({{400, 1.53}, {700, 1.51}});
  f.extinction = SpectralCurve(2.5);
  f.specular_reflectance = SpectralCurve({{380, 0.1}, {780, 0.9}});
  f.distribution = "beckmann";
  f.transmittance = SpectralCurve(0.7);
  f.angular_law = "table";
  f.by_angle = {{0.0, 1.0}, {60.0, 0.9}, {90.0, 0.0}};
  f.direct = 0.25;
  f.source = "db";
  check_same(zone, stored_and_loaded(zone, folder / "a.rays"));
}

TEST_CASE("Every kind of view comes back", "[scene][unit]") {
  const Folder folder;
  Zone zone = box_zone({2, 3, 4}, 0.5, 1.0);
  for (const auto kind : {ViewKind::perspective, ViewKind::plan, ViewKind::elevation, ViewKind::fisheye, ViewKind::hemispherical}) {
    View view{"v" + std::to_string(zone.views.size()), {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1.0, 64, 64, kind, 0.0};
    if (view.parallel()) view.width_m = 7.25;
    zone.views.push_back(view);
  }
  check_same(zone, stored_and_loaded(zone, folder / "a.rays"));
}

TEST_CASE("An empty list of points, planes and views comes back empty", "[scene][unit]") {
  const Folder folder;
  check_same(box_zone({2, 3, 4}, 0.5, 1.0),
             stored_and_loaded(box_zone({2, 3, 4}, 0.5, 1.0), folder / "a.rays"));
}

TEST_CASE("A forged zone is refused in one line, whatever does not hold together", "[scene][unit]") {
  const Folder folder;
  const std::string path = folder / "a.rays";
  CHECK(refusal(honest(), path) == "");
  const auto with = [&](auto&& change) {
    Forgery f = honest();
    change(f);
    return refusal(f, path);
  };
  const auto table = [&](std::size_t column, std::int32_t value) {
    return with([&](Forgery& f) { f.table[column] = value; });
  };
  CHECK_FALSE(table(0, 1).empty());                               // no such finish
  CHECK_FALSE(table(0, -1).empty());                              // none
  CHECK_FALSE(table(1, 7).empty());                               // no such parent
  CHECK_FALSE(table(2, -2).empty());                              // no such twin
  CHECK_FALSE(with([](Forgery& f) { f.table[6] = 3; }).empty());  // a grid of 3 x 0
  CHECK_FALSE(with([](Forgery& f) { f.n_corners = {4}; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.n_corners = {2}; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.n_corners = {0}; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.n_rings = {2}; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.n_rings = {0}; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.points.clear(); }).empty());  // the set counts one
  CHECK_FALSE(with([](Forgery& f) { f.points[1] = std::nan(""); }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.points[5] = 0.5; }).empty());           // no unit normal
  CHECK_FALSE(with([](Forgery& f) { f.frame[3] = std::nan(""); }).empty());   // u
  CHECK_FALSE(with([](Forgery& f) { f.frame[11] = -1.0; }).empty());          // n is not u x v
  CHECK_FALSE(with([](Forgery& f) { f.frame[3] = 2.0; }).empty());            // not unit
  CHECK_FALSE(table(5, 2).empty());                                           // a flag
  const auto tells = [&](const std::string& old, const std::string& now, const std::string& what) {
    const auto message =
        with([&](Forgery& f) { f.description.replace(f.description.find(old), old.size(), now); });
    CAPTURE(now, message);
    CHECK(message.find(what) != std::string::npos);
  };
  tells("[[555,0.5]]", "[[380,-5.0],[780,-5.0]]", "finishes[0].diffuse[0][1] is -5, outside 0..1");
  tells("[[555,0.5]]", "[[780,0.5],[380,0.5]]", "not in order of wavelength");
  tells("\"specular\":0.0", "\"specular\":1.5", "finishes[0].specular is 1.5");
  tells("\"gaussian\"", "\"other\"", "finishes[0].distribution is 'other'");
  tells("\"opaque\"", "\"clear\"", "finishes[0].kind is 'clear'");
  tells("\"count\":1", "\"count\":2", "point_sets[0].count is 2");
  const std::string view = R"({"name":"v","eye":[0,0,1],"focus":[1,0,1],"up":[0,0,1],"fov_rad":1.0,"size":[64,48]})";
  const auto seen = [&](const std::string& old, const std::string& now, const std::string& what) {
    std::string changed = view;
    changed.replace(changed.find(old), old.size(), now);
    tells("\"views\":[]", "\"views\":[" + changed + "]", what);
  };
  seen("1.0", "7.0", "views[0].fov_rad is 7");
  seen("[64,48]", "[64,0]", "views[0].size[1] is 0");
  seen("[64,48]", "[64,1e9]", "views[0].size[1]");
  seen("1.0", "1.0,\"kind\":\"plant\"", "views[0].kind is 'plant'");
  seen("1.0", "1.0,\"kind\":\"plan\"", "width_m");
  seen("1.0", "1.0,\"kind\":\"plan\",\"width_m\":0", "views[0].width_m is 0");
  seen("1.0", "1.0,\"kind\":\"fisheye\"", "views[0].size is not square");
  seen("[1,0,1]", "[0,0,1]", "views[0] looks nowhere");
  CHECK_FALSE(with([](Forgery& f) { f.description = "{"; }).empty());
  CHECK_FALSE(with([](Forgery& f) { f.description = R"({"name":3})"; }).empty());
  CHECK_FALSE(
      with([](Forgery& f) { f.description.replace(f.description.find("[[555,0.5]]"), 11, "[]"); }).empty());
}
