#include "scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

std::string surface(const std::string& name, const std::string& rest) {
  return "[[surface]]\nname = \"" + name + "\"\nfinish = \"wall\"\n" + rest + "\n";
}

std::string box(const std::string& name, const std::string& corner, const std::string& size) {
  return "[[box]]\nname = \"" + name + "\"\nfinish = \"wall\"\ncorner = " + corner + "\nsize = " + size + "\n";
}

struct Read {
  Zone zone;
  Warnings warnings;
};

Read read_with(const std::string& more) {
  Read result;
  result.zone = read(kRoom + more, {}, &result.warnings);
  return result;
}

double total_area(const Zone& zone) {
  double sum = 0.0;
  for (const auto& surface : zone.surfaces) sum += surface.polygon.area_m2();
  return sum;
}

constexpr double kRoomArea = 108.0;

}  // namespace

TEST_CASE("The smaller of two surfaces in one plane lies on top, with one warning", "[scene][unit]") {
  const auto [zone, warnings] = read_with(surface("picture", "vertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]"));
  CHECK(area_of(zone, "picture") == Approx(2.0));
  CHECK(area_of(zone, "south") == Approx(18.0 - 2.0));
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(72.0));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].place.line == 34);
  CHECK(warnings[0].what ==
        "surface 'picture' and surface 'south' (line 18) overlap in one plane by 2 m2: 'picture' lies on top");
  CHECK(warnings[0].cure == "write on = \"south\" if it is a feature of that surface, or move it");
}

TEST_CASE("Of two alike the later one lies on top, of several the smallest", "[scene][unit]") {
  // p and q share 1 m2, r lies across both and the wall.
  const auto [zone, warnings] =
      read_with(surface("p", "on = \"south\"\nvertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]") +
                surface("q", "on = \"south\"\nvertices = [[2,0,1],[2,0,2],[4,0,2],[4,0,1]]") +
                surface("r", "vertices = [[1.5,0,0.5],[1.5,0,1.5],[2.5,0,1.5],[2.5,0,0.5]]"));
  CHECK(area_of(zone, "r") == Approx(1.0));
  CHECK(area_of(zone, "q") == Approx(2.0 - 0.25));
  CHECK(area_of(zone, "p") == Approx(1.0 - 0.25));
  CHECK(total_area(zone) == Approx(kRoomArea));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what.find("; so do '") != std::string::npos);
}

TEST_CASE("Floors that overlap make one closed shell of the right volume", "[scene][unit]") {
  std::string text = kRoom;
  const std::string whole = "vertices = [[0,0,0],[6,0,0],[6,4,0],[0,4,0]]";
  text.replace(text.find(whole), whole.size(), "vertices = [[0,0,0],[3.4,0,0],[3.4,4,0],[0,4,0]]");
  Warnings warnings;
  const Zone zone = read(text + surface("floor2", "vertices = [[3.1,0,0],[6,0,0],[6,4,0],[3.1,4,0]]"), {}, &warnings);
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(72.0));
  CHECK(area_of(zone, "floor") == Approx(3.1 * 4.0));
  CHECK(area_of(zone, "floor2") == Approx(2.9 * 4.0));
  CHECK(warnings.size() == 1);
}

TEST_CASE("A surface that another of its size covers wholly is left out", "[scene][unit]") {
  const auto [zone, warnings] = read_with(surface("carpet", "vertices = [[0,0,0],[6,0,0],[6,4,0],[0,4,0]]"));
  CHECK(find(zone, "floor") == nullptr);
  CHECK(area_of(zone, "carpet") == Approx(24.0));
  CHECK(zone.closed);
  CHECK(warnings.size() == 1);
}

TEST_CASE("A screen in the plane of a column's face: each place has one face, seen from either side",
          "[scene][unit]") {
  // The column's south face is 0.6 x 3 m; the screen covers 0.4 x 1 m of it and stands out to the east. A screen
  // larger than the face lies below it.
  const bool large = GENERATE(false, true);
  const std::string screen =
      large ? "vertices = [[2.2,2,0],[5.2,2,0],[5.2,2,1],[2.2,2,1]]" : "vertices = [[2.2,2,0],[3.6,2,0],[3.6,2,1],[2.2,2,1]]";
  const auto [zone, warnings] =
      read_with(box("column", "[2,2,0]", "[0.6,0.6,3]") + surface("screen", "sides = 2\n" + screen));
  const double screen_m2 = large ? 3.0 : 1.4;
  CHECK(area_of(zone, "column.south") == Approx(large ? 1.8 : 1.4));
  CHECK(area_of(zone, "screen") == Approx(large ? screen_m2 - 0.4 : screen_m2));
  CHECK(area_of(zone, "screen.back") == Approx(screen_m2 - 0.4));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what.find("overlap in one plane by 0.4 m2") != std::string::npos);
}

TEST_CASE("Two panels in one plane, whichever way they face: both lose the same on both sides", "[scene][unit]") {
  const bool turned = GENERATE(false, true);
  const auto [zone, warnings] = read_with(
      surface("a", "sides = 2\nvertices = [[1,2,0.5],[3,2,0.5],[3,2,1.5],[1,2,1.5]]") +
      surface("b", std::string("sides = 2\nvertices = ") + (turned ? "[[2,2,0.5],[2,2,1.5],[3.5,2,1.5],[3.5,2,0.5]]"
                                                                  : "[[2,2,0.5],[3.5,2,0.5],[3.5,2,1.5],[2,2,1.5]]")));
  for (const char* face : {"b", "b.back"}) CHECK(area_of(zone, face) == Approx(1.5));
  for (const char* face : {"a", "a.back"}) CHECK(area_of(zone, face) == Approx(1.0));
  CHECK(warnings.size() == 1);
}

TEST_CASE("A box that stands on a rug on a floor takes its foot out of both", "[scene][unit]") {
  const auto [zone, warnings] = read_with(surface("rug", "vertices = [[1,1,0],[3,1,0],[3,3,0],[1,3,0]]") +
                                          box("plinth", "[2.5,1.5,0]", "[1,1,1]"));
  CHECK(find(zone, "plinth.bottom") == nullptr);
  CHECK(area_of(zone, "rug") == Approx(4.0 - 0.5));
  CHECK(area_of(zone, "floor") == Approx(24.0 - 4.0 - 0.5));
  CHECK(warnings.size() == 1);
}

TEST_CASE("A feature on a two-sided panel leaves the panel's back whole", "[scene][unit]") {
  const auto [zone, warnings] =
      read_with(surface("panel", "sides = 2\nvertices = [[1,2,0.5],[3,2,0.5],[3,2,1.5],[1,2,1.5]]") +
                surface("notice", "on = \"panel\"\nvertices = [[1.5,2,0.7],[2,2,0.7],[2,2,1],[1.5,2,1]]"));
  CHECK(area_of(zone, "panel") == Approx(1.85));
  CHECK(area_of(zone, "panel.back") == Approx(2.0));
  CHECK(area_of(zone, "notice") == Approx(0.15));
  CHECK(warnings.empty());
}
