#include "scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// The room with one surface's corners listed the other way round, or left out.
std::string without(std::string text, const std::string& name) {
  const auto at = text.find("[[surface]]\nname = \"" + name + "\"");
  const auto end = text.find("[[surface]]", at + 5);
  return text.erase(at, end == std::string::npos ? end : end - at);
}

const std::string kSouth = "vertices = [[0,0,0],[0,0,3],[6,0,3],[6,0,0]]";
const std::string kSouthTurned = "vertices = [[0,0,0],[6,0,0],[6,0,3],[0,0,3]]";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("A closed room is closed and its volume is exact", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(kRoom, {}, &warnings);
  CHECK(zone.closed);
  CHECK(zone_volume_m3(zone) == Approx(72).epsilon(1e-14));
  CHECK(warnings.empty());
}

TEST_CASE("A missing wall leaks at three edges shown and the rest counted", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(without(kRoom, "south"), {}, &warnings);
  CHECK_FALSE(zone.closed);
  REQUIRE(warnings.size() == 3);
  CHECK(warnings[0].what ==
        "the zone is not closed: the edge of 'floor' from (0, 0, 0) to (6, 0, 0) meets no other surface");
  CHECK(warnings[0].place.line == 10);
  CHECK(warnings[2].what.ends_with("(and 1 more edges)"));
}

TEST_CASE("A wall turned outwards is named with the cure", "[scene][unit]") {
  const auto problems = problems_of(replaced(kRoom, kSouth, kSouthTurned));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0] ==
        "18:12 surface 'south' faces out of the zone | list its corners the other way round: "
        "counter-clockwise seen from the lit side");
}

TEST_CASE("A room turned inside out is reported once", "[scene][unit]") {
  std::string text = R"(dim = "zone/1"
finishes = { w = 0.5 }
)";
  // The faces of a box written as surfaces face outwards.
  const std::vector<std::string> rings = {
      "[[0,0,1],[1,0,1],[1,1,1],[0,1,1]]", "[[0,0,0],[0,1,0],[1,1,0],[1,0,0]]",
      "[[0,0,0],[1,0,0],[1,0,1],[0,0,1]]", "[[1,1,0],[0,1,0],[0,1,1],[1,1,1]]",
      "[[0,1,0],[0,0,0],[0,0,1],[0,1,1]]", "[[1,0,0],[1,1,0],[1,1,1],[1,0,1]]"};
  for (std::size_t i = 0; i < rings.size(); ++i)
    text +=
        "[[surface]]\nname = \"s" + std::to_string(i) + "\"\nfinish = \"w\"\nvertices = " + rings[i] + "\n";
  const auto problems = problems_of(text);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].starts_with("6:12 surface 's0' and all 5 that it meets face out of the zone"));
}

TEST_CASE("Walls in pieces against one ceiling are closed", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(replaced(kRoom, kSouth, "vertices = [[0,0,0],[0,0,3],[2.5,0,3],[2.5,0,0]]") + R"(
[[surface]]
name = "south2"
finish = "wall"
vertices = [[2.5,0,0],[2.5,0,3],[6,0,3],[6,0,0]]
)",
                         {}, &warnings);
  CHECK(zone.closed);
  CHECK(warnings.empty());
  CHECK(zone.volume_m3 == Approx(72));
}

TEST_CASE("A piece turned outwards is found where edges meet in part", "[scene][unit]") {
  const auto problems =
      problems_of(replaced(kRoom, kSouth, "vertices = [[0,0,0],[0,0,3],[2.5,0,3],[2.5,0,0]]") + R"(
[[surface]]
name = "south2"
finish = "wall"
vertices = [[2.5,0,0],[6,0,0],[6,0,3],[2.5,0,3]]
)");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].starts_with("35:12 surface 'south2' faces out of the zone"));
}

TEST_CASE("A slit between wall pieces leaks and is located", "[scene][unit]") {
  Warnings warnings;
  read(replaced(kRoom, kSouth, "vertices = [[0,0,0],[0,0,3],[2.5,0,3],[2.5,0,0]]") + R"(
[[surface]]
name = "south2"
finish = "wall"
vertices = [[2.6,0,0],[2.6,0,3],[6,0,3],[6,0,0]]
)",
       {}, &warnings);
  REQUIRE(warnings.size() == 3);
  CHECK(warnings[0].what ==
        "the zone is not closed: the edge of 'south' from (2.5, 0, 3) to (2.5, 0, 0) meets no other surface");
  CHECK(warnings[1].what.find("'south2' from (2.6, 0, 0) to (2.6, 0, 3)") != std::string::npos);
}

TEST_CASE("Furniture written as surfaces does not leak, face the wrong way or count in the volume",
          "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(kRoom + R"(
[[surface]]
name = "top"
finish = "dark"
vertices = [[2,1,1],[3,1,1],[3,2,1],[2,2,1]]
[[surface]]
name = "front"
finish = "dark"
vertices = [[2,1,0],[3,1,0],[3,1,1],[2,1,1]]
[[surface]]
name = "back"
finish = "dark"
vertices = [[3,2,0],[2,2,0],[2,2,1],[3,2,1]]
[[surface]]
name = "left"
finish = "dark"
vertices = [[2,2,0],[2,1,0],[2,1,1],[2,2,1]]
[[surface]]
name = "right"
finish = "dark"
vertices = [[3,1,0],[3,2,0],[3,2,1],[3,1,1]]
[[surface]]
name = "shelf, free in the air"
finish = "dark"
vertices = [[4,1,2],[5,1,2],[5,2,2],[4,2,2]]
)",
                         {}, &warnings);
  CHECK(zone.closed);
  CHECK(warnings.empty());
  CHECK(zone.volume_m3 == Approx(72));
}

TEST_CASE("A hole in a wall leaks unless a surface fills it", "[scene][unit]") {
  const std::string holed = replaced(kRoom, kSouth, kSouth + "\nholes = [[[1,0,1],[2,0,1],[2,0,2],[1,0,2]]]");
  Warnings warnings;
  CHECK_FALSE(read(holed, {}, &warnings).closed);
  CHECK(warnings.size() == 3);
  warnings.clear();
  const Zone zone = read(holed + R"(
[[surface]]
name = "pane"
finish = "dark"
vertices = [[1,0,1],[1,0,2],[2,0,2],[2,0,1]]
)",
                         {}, &warnings);
  CHECK(zone.closed);
  CHECK(area_of(zone, "south") == Approx(17));
}

TEST_CASE("Two rooms in one file are each closed and their volumes add", "[scene][unit]") {
  std::string text = kRoom;
  for (const char* name : {"floor", "ceiling", "south", "north", "west", "east"})
    text += std::string("[[copy]]\nof = \"") + name + "\"\nnames = [\"" + name + "2\"]\nby = [[10,0,0]]\n";
  Warnings warnings;
  const Zone zone = read(text, {}, &warnings);
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(144));
}

TEST_CASE("An L-shaped room with sloping ceiling has its exact volume", "[scene][unit]") {
  // L of 6 x 4 less 4 x 2, height 2 + x/2: volume = integral over the L of (2 + x/2)
  //  = [0,6]x[0,2]: 2*(12 + 9) = 42; [0,2]x[2,4]: 2*(4 + 1) = 10.
  Warnings warnings;
  const Zone zone = read(R"(dim = "zone/1"
finishes = { w = 0.5 }
[[surface]]
name = "floor"
finish = "w"
vertices = [[0,0,0],[6,0,0],[6,2,0],[2,2,0],[2,4,0],[0,4,0]]
[[surface]]
name = "roof"
finish = "w"
vertices = [[0,0,2],[0,4,2],[2,4,3],[2,2,3],[6,2,5],[6,0,5]]
[[surface]]
name = "a"
finish = "w"
vertices = [[0,0,0],[0,0,2],[6,0,5],[6,0,0]]
[[surface]]
name = "b"
finish = "w"
vertices = [[6,0,0],[6,0,5],[6,2,5],[6,2,0]]
[[surface]]
name = "c"
finish = "w"
vertices = [[6,2,0],[6,2,5],[2,2,3],[2,2,0]]
[[surface]]
name = "d"
finish = "w"
vertices = [[2,2,0],[2,2,3],[2,4,3],[2,4,0]]
[[surface]]
name = "e"
finish = "w"
vertices = [[2,4,0],[2,4,3],[0,4,2],[0,4,0]]
[[surface]]
name = "f"
finish = "w"
vertices = [[0,4,0],[0,4,2],[0,0,2],[0,0,0]]
)",
                         {}, &warnings);
  CHECK(zone.closed);
  CHECK(warnings.empty());
  CHECK(zone.volume_m3 == Approx(52).epsilon(1e-13));
}

TEST_CASE("Glass on a box is refused: it has the zone on both sides", "[scene][unit]") {
  const std::string box = "glass = { kind = \"glazing\", transmittance = 0.7 }\n";
  std::string text = kRoom;
  text.insert(text.find("[[surface]]"), box);
  text += "[[box]]\nname = \"b\"\nfinish = \"wall\"\ncorner = [1,1,0]\nsize = [1,1,1]\n[[surface]]\nname = \"pane\"\n"
          "on = \"b.top\"\nfinish = \"glass\"\nvertices = [[1.2,1.2,1],[1.8,1.2,1],[1.8,1.8,1],[1.2,1.8,1]]\n";
  const auto problems = problems_of(text);
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0], Catch::Contains("'pane' is glazed, but not part of the zone's shell"));
}
