// What makes polygons that face their room of the triangles of other programs.
#include <fmt/format.h>

#include <random>

#include "import_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

std::vector<Triangle> turned_at_random(std::vector<Triangle> triangles, unsigned seed) {
  std::mt19937 random(seed);
  for (Triangle& t : triangles)
    if (random() % 2 == 0) std::swap(t.b, t.c);
  return triangles;
}

const std::vector<Triangle> kRoomBox = box_triangles("room", {0, 0, 0}, {6, 4, 3});

}  // namespace

TEST_CASE("A box of triangles that face at random is a room of six walls", "[import][unit]") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto result =
        import_text(obj_text(turned_at_random(box_triangles("room", {0, 0, 0}, {6, 4, 3}, 5), seed)), "obj");
    Warnings warnings;
    const Zone zone = zone_of(result, &warnings);
    CHECK(warnings.empty());
    CHECK(zone.surfaces.size() == 6);
    CHECK(zone.closed);
    CHECK(zone.volume_m3 == Approx(72.0).epsilon(1e-12));
    CHECK(total_area(zone) == Approx(108.0).epsilon(1e-12));
    CHECK(result.report.n_merged == 300);
    // Looking up from below: the bottom's lit side is its upper one.
    CHECK(find(zone, "room0")->polygon.normal().z == Approx(1.0));
    REQUIRE(result.report.rooms.size() == 1);
    CHECK(result.report.rooms[0].volume_after_m3 == Approx(72.0));
  }
}

TEST_CASE("Bodies in a room face outwards, whatever way they came", "[import][unit]") {
  const auto model = kRoomBox + box_triangles("desk", {1, 1, 0.7}, {1, 1, 0.03}) +
                     box_triangles("pen", {1.4, 1.4, 0.8}, {0.1, 0.01, 0.01});
  const Zone zone = zone_of(import_text(obj_text(turned_at_random(model, 7)), "obj"));
  CHECK(zone.surfaces.size() == 18);
  CHECK(find(zone, "desk1")->polygon.normal().z == Approx(1.0));
  CHECK(find(zone, "desk0")->polygon.normal().z == Approx(-1.0));
  CHECK(find(zone, "pen2")->polygon.normal().y == Approx(-1.0));
  CHECK(zone.volume_m3 == Approx(72.0));
}

TEST_CASE("A body that stands on the floor loses what it stands on", "[import][unit]") {
  Warnings warnings;
  const Zone zone = zone_of(
      import_text(obj_text(kRoomBox + box_triangles("cube", {1, 1, 0}, {1, 1, 1})), "obj"), &warnings);
  CHECK(area_of(zone, "room0") == Approx(23.0));
  CHECK(area_of(zone, "cube0") == 0.0);
  CHECK(area_of(zone, "cube1") == Approx(1.0));
  CHECK(warns_of(warnings, "touch back to back"));
}

TEST_CASE("A sheet in a room has two sides, one on a wall is lit as the wall", "[import][unit]") {
  const std::vector<Triangle> sheets = {{"screen", {2, 1, 0.5}, {3, 1, 0.5}, {2, 1, 1.5}},
                                        {"poster", {0, 1, 1}, {0, 1, 2}, {0, 2, 1}}};
  const Zone zone = zone_of(import_text(obj_text(kRoomBox + sheets), "obj"));
  REQUIRE(find(zone, "screen.back"));
  CHECK_FALSE(find(zone, "poster.back"));
  CHECK(find(zone, "poster")->polygon.normal().x == Approx(1.0));
  CHECK(area_of(zone, "room5") == Approx(11.5));
}

TEST_CASE("An open box in a room is no room", "[import][unit]") {
  auto drawer = box_triangles("drawer", {1, 1, 0.5}, {0.5, 0.5, 0.3});
  std::erase_if(drawer, [](const Triangle& t) { return t.group == "drawer1"; });
  const auto result = import_text(obj_text(kRoomBox + drawer), "obj");
  CHECK(result.report.rooms.size() == 1);
  const Zone zone = zone_of(result);
  for (const char* name : {"drawer0", "drawer2", "drawer5"}) CHECK(find(zone, std::string(name) + ".back"));
}

TEST_CASE("A room without a ceiling still has an inside, and is told where it is open", "[import][unit]") {
  auto model = kRoomBox;
  std::erase_if(model, [](const Triangle& t) { return t.group == "room1"; });
  const auto result = import_text(obj_text(turned_at_random(model, 3)), "obj");
  Warnings warnings;
  const Zone zone = zone_of(result, &warnings);
  CHECK_FALSE(zone.closed);
  CHECK(find(zone, "room0")->polygon.normal().z == Approx(1.0));
  CHECK(find(zone, "room2")->polygon.normal().y == Approx(1.0));
  CHECK(warns_of(warnings, "from (0, 0, 3) to (6, 0, 3)"));
  REQUIRE(result.report.rooms.size() == 1);
  CHECK_FALSE(result.report.rooms[0].closed);
}

TEST_CASE("Rooms apart are rooms each; --inside keeps one", "[import][unit]") {
  const auto two = kRoomBox + box_triangles("store", {10, 0, 0}, {2, 2, 2});
  CHECK(import_text(obj_text(two), "obj").report.rooms.size() == 2);
  ImportOptions options;
  options.inside = Vec3(11, 1, 1);
  const auto result = import_text(obj_text(two), "obj", options);
  REQUIRE(result.report.rooms.size() == 1);
  CHECK(result.report.rooms[0].volume_after_m3 == Approx(8.0));
  options.inside = Vec3(8, 1, 1);
  CHECK(refusal(obj_text(two), "obj", options).find("lies in no space") != std::string::npos);
}

TEST_CASE("A partition between two rooms is lit on either side by its own room", "[import][unit]") {
  auto halves = box_triangles("a", {0, 0, 0}, {3, 4, 3}) + box_triangles("b", {3, 0, 0}, {3, 4, 3});
  const auto result = import_text(obj_text(halves), "obj");
  CHECK(result.report.n_pairs == 2);
  REQUIRE(result.report.rooms.size() == 2);
  CHECK(result.report.rooms[0].volume_after_m3 == Approx(36.0));
  const Zone zone = zone_of(result);
  CHECK(zone.closed);
  CHECK(glm::dot(find(zone, "a3")->polygon.normal(), find(zone, "a3.2")->polygon.normal()) == Approx(-1.0));
}

TEST_CASE("Copies, degenerate faces and gaps are put right and counted", "[import][unit]") {
  auto model = kRoomBox;
  model.push_back(model[0]);                                    // a copy
  model.push_back({"room0", {1, 1, 0}, {2, 1, 0}, {3, 1, 0}});  // no width
  for (Triangle& t : model)
    if (t.group == "room3") t.a.x += 5e-5, t.b.x += 5e-5, t.c.x += 5e-5;  // a wall 0.05 mm off
  const auto result = import_text(obj_text(model), "obj", {.gap_m = 1e-4});
  CHECK(result.report.n_copies == 1);
  CHECK(result.report.n_degenerate == 1);
  CHECK(zone_of(result).closed);
}

TEST_CASE("Edges that meet in part close the room", "[import][unit]") {
  // The floor in two pieces against walls in one.
  auto model = kRoomBox;
  std::erase_if(model, [](const Triangle& t) { return t.group == "room0"; });
  model = model + std::vector<Triangle>{{"floor-w", {0, 0, 0}, {2, 0, 0}, {2, 4, 0}},
                                        {"floor-w", {0, 0, 0}, {2, 4, 0}, {0, 4, 0}},
                                        {"floor-e", {2, 0, 0}, {6, 0, 0}, {6, 4, 0}},
                                        {"floor-e", {2, 0, 0}, {6, 4, 0}, {2, 4, 0}}};
  const Zone zone = zone_of(import_text(obj_text(model), "obj"));
  CHECK(zone.closed);
  CHECK(area_of(zone, "floor-w") == Approx(8.0));
  CHECK(find(zone, "floor-e")->polygon.normal().z == Approx(1.0));
}

TEST_CASE("Edges that run to and fro become holes, whichever way the hole is walked round",
          "[import][unit]") {
  for (const char* hole : {"5 8 7 6 5", "5 6 7 8 5"}) {
    const std::string text = fmt::format(
        "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nf 1 {} 1 2 3 4\n", hole);
    const auto result = import_text(text, "obj");
    CHECK(result.report.area_written_m2 == Approx(11.0));
    CHECK(result.zone.find("holes = ") != std::string::npos);
  }
}

TEST_CASE("Bent faces are cut into triangles, crossing outlines into parts", "[import][unit]") {
  const auto bent = import_text("v 0 0 0\nv 1 0 0\nv 1 1 0.2\nv 0 1 0\nf 1 2 3 4\n", "obj");
  CHECK(bent.report.n_split == 1);
  CHECK(bent.report.n_written == 2);
  // The two triangles of a bow: 0.25 m2 each.
  const auto bow = import_text("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1.5 0\nv 0.5 2 0\nf 1 2 3 4 5\n", "obj");
  CHECK(bow.report.n_mended == 1);
  CHECK(zone_of(bow).surfaces.size() >= 2);
}

TEST_CASE("Units and axes: what is asked for, else what the file states", "[import][unit]") {
  const std::string millimetres = obj_text(box_triangles("room", {0, 0, 0}, {6000, 4000, 3000}));
  CHECK(warns_of(import_text(millimetres, "obj").warnings, "hardly a room"));
  ImportOptions options;
  options.unit_m = 0.001;
  CHECK(zone_of(import_text(millimetres, "obj", options)).volume_m3 == Approx(72.0));
  // Two units up along y: the height of what is written.
  options = {};
  options.up = UpAxis::y;
  const Zone zone =
      zone_of(import_text(obj_text(box_triangles("room", {0, 0, 0}, {6, 2, 4})), "obj", options));
  CHECK(find(zone, "room2")->polygon.normal().z == Approx(1.0));
  CHECK(zone.surfaces.size() == 6);
}

TEST_CASE("Every import says what it leaves a zone in: areas, volume, names", "[import][unit]") {
  const auto lines = summary_lines(import_text(obj_text(kRoomBox), "obj").report);
  CHECK(lines.front() == "12 faces of 108 m2 read, 6 surfaces of 108 m2 written");
  CHECK(lines.back() == "space 1: 6 surfaces, 108 m2 before, 108 m2 after; 72 m3 before, 72 m3 after");
}

TEST_CASE("Names that are no UTF-8, empty or used twice are written anew", "[import][unit]") {
  const std::string text =
      "g K\xfc"
      "che\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf 4 5 6\n";
  const auto result = import_text(text, "obj");
  CHECK(result.zone.find("name = \"K\xc3\xbc"
                         "che\"") != std::string::npos);
  CHECK(result.zone.find("name = \"K\xc3\xbc"
                         "che.2\"") != std::string::npos);
  REQUIRE(result.report.changes.size() == 1);
  CHECK(result.report.changes[0].find("Küche") != std::string::npos);
}
