#include "scene_support.hpp"
#include "scene/zone_assembly.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("A room reads as six surfaces centred on the origin", "[scene][unit]") {
  const Zone zone = read(kRoom);
  REQUIRE(zone.surfaces.size() == 6);
  CHECK(zone.name == "room");
  CHECK(zone.origin_m == Vec3(3, 2, 1.5));
  CHECK(zone.diameter_m == Approx(std::sqrt(36.0 + 16 + 9)));
  CHECK(zone.volume_m3 == Approx(72));
  CHECK(zone.surfaces[0].polygon.area_m2() == Approx(24));
  CHECK(zone.surfaces[0].polygon.normal().z == Approx(1));
  CHECK(zone.surfaces[0].cell_m == 0.5);
  CHECK(zone.finishes[static_cast<std::size_t>(zone.surfaces[0].finish)].diffuse.at(500) == 0.2);
}

TEST_CASE("A box has six outward faces, turned about its corner", "[scene][unit]") {
  const Zone zone = read(kRoom + R"(
[[box]]
name = "desk"
finish = "dark"
corner = [3,1,0.7]
size = [1.2,0.6,0.05]
turn = 90
)");
  REQUIRE(zone.surfaces.size() == 12);
  const Vec3 shift = zone.origin_m;
  const Surface& top = *find(zone, "desk.top");
  CHECK(top.polygon.area_m2() == Approx(0.72));
  CHECK(glm::length(top.polygon.centroid() + shift - Vec3(3 - 0.3, 1 + 0.6, 0.75)) < 1e-12);
  CHECK(top.polygon.normal().z == Approx(1));
  CHECK_FALSE(top.bounding);
  // The box's own south, -y, points to +x after a quarter turn.
  CHECK(find(zone, "desk.south")->polygon.normal().x == Approx(1));
  CHECK(find(zone, "desk.north")->polygon.normal().x == Approx(-1));
  CHECK(find(zone, "desk.east")->polygon.normal().y == Approx(1));
  CHECK(find(zone, "desk.west")->polygon.normal().y == Approx(-1));
  CHECK(find(zone, "desk.bottom")->polygon.normal().z == Approx(-1));
  double flux = 0.0;
  for (const auto& surface : zone.surfaces)
    if (surface.name.starts_with("desk"))
      flux +=
          glm::dot(surface.polygon.centroid(), surface.polygon.normal()) * surface.polygon.area_m2() / 3.0;
  CHECK(flux == Approx(1.2 * 0.6 * 0.05));
}

TEST_CASE("Copies of boxes, surfaces and copies are displaced", "[scene][unit]") {
  const Zone zone = read(kRoom + R"(
[[surface]]
name = "panel"
finish = "wall"
sides = 2
vertices = [[1,1,1],[2,1,1],[2,1,2],[1,1,2]]
[[box]]
name = "a"
finish = "wall"
corner = [1,2,0.5]
size = [0.5,0.5,0.5]
[[copy]]
of = "a"
names = ["b", "c"]
by = [[1,0,0],[2,0,0]]
[[copy]]
of = "c"
names = ["d"]
by = [[1,0.5,0]]
[[copy]]
of = "panel"
names = ["panel2"]
by = [[0,0.5,0]]
)");
  CHECK(zone.surfaces.size() == 6 + 2 + 4 * 6 + 2);
  const Vec3 moved = find(zone, "d.top")->polygon.centroid() - find(zone, "a.top")->polygon.centroid();
  CHECK(glm::length(moved - Vec3(3, 0.5, 0)) < 1e-12);
  const Surface& front = *find(zone, "panel2");
  const Surface& back = *find(zone, "panel2.back");
  CHECK(&zone.surfaces[static_cast<std::size_t>(front.twin)] == &back);
  CHECK(&zone.surfaces[static_cast<std::size_t>(back.twin)] == &front);
  CHECK(glm::length(front.polygon.normal() + back.polygon.normal()) < 1e-15);
  CHECK_FALSE(front.bounding);
}

TEST_CASE("A window and its pane are cut out of wall and window", "[scene][unit]") {
  const Zone zone = read(kRoom + R"(
[[surface]]
name = "window"
finish = "dark"
on = "south"
vertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]
[[surface]]
name = "pane"
finish = "dark"
on = "window"
vertices = [[1.1,0,1.1],[1.1,0,1.9],[2.9,0,1.9],[2.9,0,1.1]]
[[surface]]
name = "door"
finish = "dark"
on = "south"
vertices = [[4,0,0],[4,0,2],[5,0,2],[5,0,0]]
)");
  CHECK(area_of(zone, "south") == Approx(18 - 2 - 2).epsilon(1e-13));
  CHECK(area_of(zone, "window") == Approx(2 - 1.8 * 0.8).epsilon(1e-13));
  CHECK(area_of(zone, "pane") == Approx(1.8 * 0.8).epsilon(1e-13));
  CHECK(zone.surfaces[static_cast<std::size_t>(find(zone, "pane")->parent)].name == "window");
  CHECK(find(zone, "pane")->bounding);
  CHECK_FALSE(find(zone, "south")->fills_rectangle);
  CHECK(find(zone, "pane")->fills_rectangle);
  CHECK(zone.volume_m3 == Approx(72));
}

TEST_CASE("A cabinet on the floor and against a wall loses the faces that touch", "[scene][unit]") {
  const Zone zone = read(kRoom + R"(
[[box]]
name = "cabinet"
finish = "dark"
corner = [2,3.6,0]
size = [1,0.4,2]
)");
  CHECK(find(zone, "cabinet.bottom") == nullptr);
  CHECK(find(zone, "cabinet.north") == nullptr);
  CHECK(zone.surfaces.size() == 6 + 4);
  CHECK(area_of(zone, "floor") == Approx(24 - 0.4).epsilon(1e-13));
  CHECK(area_of(zone, "north") == Approx(18 - 2).epsilon(1e-13));
  CHECK(zone.volume_m3 == Approx(72));
  // What they lack of a rectangle lies under the cabinet.
  CHECK_FALSE(find(zone, "floor")->polygon.is_rectangle());
  CHECK(find(zone, "floor")->fills_rectangle);
  CHECK(find(zone, "north")->fills_rectangle);
}

TEST_CASE("A plane's points are the middles of squares of at most the spacing", "[scene][unit]") {
  const Zone zone = read(kRoom + R"(
[[plane]]
name = "work"
vertices = [[0.5,0.5,0.75],[5.5,0.5,0.75],[5.5,3.5,0.75],[0.5,3.5,0.75]]
spacing = 0.5
[[sensors]]
name = "eyes"
points = [[1,1,1, 0,0,2], [2,2,1.2, 1,0,0]]
[[view]]
name = "door"
eye = [0.3,0.3,1.6]
focus = [5,3,0.8]
fov = 90
)");
  REQUIRE(zone.planes.size() == 1);
  CHECK(zone.planes[0].nu == 10);
  CHECK(zone.planes[0].nv == 6);
  REQUIRE(zone.point_sets.size() == 2);
  CHECK(zone.point_sets[0].count == 60);
  CHECK(zone.point_sets[1].first == 60);
  CHECK(glm::length(zone.points[0].position + zone.origin_m - Vec3(0.75, 0.75, 0.75)) < 1e-12);
  CHECK(glm::length(zone.points[1].position + zone.origin_m - Vec3(1.25, 0.75, 0.75)) < 1e-12);
  CHECK(zone.points[60].normal == Vec3(0, 0, 1));
  CHECK(zone.views[0].fov_rad == Approx(kPi / 2));
}

TEST_CASE("--set changes any value, also inside a finish written as a name or number", "[scene][unit]") {
  const Zone zone =
      read(kRoom, {"finishes.wall.diffuse=0.7", "cell=0.2", "surface.floor.finish=wall", "name=a b"});
  CHECK(zone.name == "a b");
  CHECK(zone.surfaces[0].cell_m == 0.2);
  CHECK(zone.finishes[static_cast<std::size_t>(zone.surfaces[0].finish)].diffuse.at(500) == 0.7);
}

TEST_CASE("Two surfaces of one outline back to back are a thin partition and stay", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(kRoom + R"([[surface]]
name = "front"
finish = "wall"
vertices = [[3,1,0],[3,2,0],[3,2,2],[3,1,2]]
[[surface]]
name = "rear"
finish = "dark"
vertices = [[3,1,0],[3,1,2],[3,2,2],[3,2,0]]
)",
                         {}, &warnings);
  CHECK(area_of(zone, "front") == Approx(2));
  CHECK(area_of(zone, "rear") == Approx(2));
  CHECK(zone.surfaces[static_cast<std::size_t>(find(zone, "front")->twin)].name == "rear");
  CHECK(warnings.empty());
}

TEST_CASE("Surfaces that touch back to back in part lose what they share, with a warning", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(kRoom + R"([[surface]]
name = "cupboard back"
finish = "wall"
vertices = [[1,0,1],[2,0,1],[2,0,2],[1,0,2]]
)",
                         {}, &warnings);
  CHECK(area_of(zone, "south") == Approx(17));
  CHECK(find(zone, "cupboard back") == nullptr);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what ==
        "surface 'cupboard back' and surface 'south' touch back to back: their common 1 m2 is left out");
}

TEST_CASE("Stacked boxes lose both faces where they meet", "[scene][unit]") {
  const Zone zone = read(kRoom + R"([[box]]
name = "low"
finish = "wall"
corner = [1,1,0]
size = [1,1,0.5]
turn = 20
[[box]]
name = "high"
finish = "wall"
corner = [1,1,0.5]
size = [0.5,1,0.5]
turn = 20
)");
  CHECK(find(zone, "high.bottom") == nullptr);
  CHECK(area_of(zone, "low.top") == Approx(0.5).epsilon(1e-12));
  CHECK(area_of(zone, "floor") == Approx(23).epsilon(1e-12));
  // The two west sides lie in one plane, one above the other: nothing is shared.
  CHECK(area_of(zone, "high.west") == Approx(0.5).epsilon(1e-12));
  CHECK(area_of(zone, "low.west") == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("External obstructions are kept whole and bound nothing", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(kRoom + R"([[surface]]
name = "opposite"
finish = "dark"
outside = true
vertices = [[-5,-20,0],[-5,-20,10],[11,-20,10],[11,-20,0]]
[[box]]
name = "next door"
finish = "dark"
outside = true
corner = [6,0,0]
size = [4,4,3]
)",
                         {}, &warnings);
  CHECK(zone.closed);
  CHECK(warnings.empty());
  CHECK(find(zone, "opposite")->outside);
  CHECK(find(zone, "next door.west")->polygon.area_m2() == Approx(12));
  CHECK(area_of(zone, "east") == Approx(12));
}

TEST_CASE("Finishes come from the database, with keys of their own over them", "[scene][unit]") {
  const DatabaseSearch search{{std::string(DIM_SOURCE_DIR) + "/db"}};
  Warnings warnings;
  std::string text = kRoom;
  text.replace(text.find("wall = 0.5"), 10, "wall = \"paint-white-matt\"");
  text.replace(text.find("dark = { diffuse = 0.2 }"), 24,
               "dark = { entry = \"carpet-grey\", specular = 0.1 }");
  const auto finish = [&](const std::vector<std::string>& overrides, std::size_t surface) {
    const Zone zone = read_zone(text, "z.toml", overrides, 0.0, search, warnings);
    return zone.finishes[static_cast<std::size_t>(zone.surfaces[surface].finish)];
  };
  CHECK(finish({}, 1).diffuse.at(555) == 0.84);
  CHECK(finish({}, 1).name == "wall");
  CHECK(finish({}, 1).source == "paint-white-matt");
  CHECK(finish({}, 0).diffuse.at(555) == 0.15);
  CHECK(finish({}, 0).specular == 0.1);
  CHECK(finish({"finishes.wall.diffuse=0.7"}, 1).diffuse.at(555) == 0.7);
  CHECK(finish({"finishes.wall=concrete-smooth"}, 1).diffuse.at(555) == 0.35);
  CHECK_THROWS_WITH(finish({"finishes.wall=concrete-smoth"}, 1),
                    Catch::Matchers::Contains("did you mean 'concrete-smooth'?"));
}

TEST_CASE("A cell size given apart replaces the file's, not a surface's own", "[scene][unit]") {
  Warnings warnings;
  std::string text = kRoom;
  text.insert(text.find("finish = \"dark\""), "cell = 0.1\n");
  const Zone zone = read_zone(text, "z.toml", {}, 0.3, {}, warnings);
  CHECK(zone.surfaces[0].cell_m == 0.1);
  CHECK(zone.surfaces[1].cell_m == 0.3);
  text.erase(text.find("cell = 0.5"), 10);
  CHECK(read_zone(text, "z.toml", {}, 0.0, {}, warnings).surfaces[1].cell_m == kDefaultCell_m);
}
