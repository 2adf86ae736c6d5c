#include "scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

std::vector<std::string> warnings_of(const std::string& text,
                                     const std::vector<std::string>& overrides = {}) {
  Warnings warnings;
  read(text, overrides, &warnings);
  std::vector<std::string> said;
  for (const auto& warning : warnings) said.push_back(to_string(warning));
  return said;
}

// The room of 6 x 4 x 3 with a desk of 1.4 x 0.7 x 0.72 on the floor and a view.
const std::string kDesk = kRoom + R"([[box]]
name = "desk"
finish = "wall"
corner = [1,1,0]
size = [1.4,0.7,0.72]
[[view]]
name = "door"
eye = [0.3,0.3,1.6]
focus = [3,2,1]
)";

void only(const std::vector<std::string>& said, const std::string& words, const std::string& cure) {
  INFO(words);
  for (const auto& line : said) UNSCOPED_INFO(line);
  REQUIRE(said.size() == 1);
  CHECK(said[0].find(words) != std::string::npos);
  CHECK(said[0].find(cure) != std::string::npos);
  CHECK((said[0].starts_with("room.toml:") || said[0].starts_with("--set ")));
}

// What is left of a zone's furniture; the one warning says how.
Zone with_warning(const std::string& text, const std::vector<std::string>& overrides, const std::string& words) {
  Warnings warnings;
  Zone zone = read(text, overrides, &warnings);
  REQUIRE(warnings.size() == 1);
  INFO(warnings[0].what);
  CHECK(warnings[0].what.find(words) != std::string::npos);
  return zone;
}

Zone cut_off(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return with_warning(text, overrides, "the part outside is cut off");
}

// Areas of the furniture and of what the walls lost to it, as vectors: nothing, where it is closed.
Vec3 open_area_m2(const Zone& zone, const Vec3& room_m) {
  Vec3 sum(0.0);
  for (const auto& surface : zone.surfaces) sum += surface.polygon.area_m2() * surface.polygon.normal();
  Vec3 lost(0.0);
  const Vec3 walls_m2{room_m.y * room_m.z, room_m.x * room_m.z, room_m.x * room_m.y};
  for (const auto& surface : zone.surfaces)
    if (surface.bounding) lost += surface.polygon.area_m2() * glm::abs(surface.polygon.normal());
  CHECK(glm::length(lost) < 2.0 * glm::length(walls_m2) - 0.05);
  return sum;
}

std::string box(const std::string& corner, const std::string& size, const std::string& turn = "0") {
  return "[[box]]\nname = \"b\"\nfinish = \"wall\"\ncorner = " + corner + "\nsize = " + size +
         "\nturn = " + turn + "\n";
}

// 6 x 4 x 3 with the quarter x > 3, y > 2 taken away.
const std::string kAngle = R"(dim = "zone/1"
name = "angle"
cell = 0.5
finishes = { wall = 0.5 }
[[surface]]
name = "floor"
finish = "wall"
vertices = [[0,0,0],[6,0,0],[6,2,0],[3,2,0],[3,4,0],[0,4,0]]
[[surface]]
name = "ceiling"
finish = "wall"
vertices = [[0,0,3],[0,4,3],[3,4,3],[3,2,3],[6,2,3],[6,0,3]]
[[surface]]
name = "south"
finish = "wall"
vertices = [[0,0,0],[0,0,3],[6,0,3],[6,0,0]]
[[surface]]
name = "east"
finish = "wall"
vertices = [[6,0,0],[6,0,3],[6,2,3],[6,2,0]]
[[surface]]
name = "inner-n"
finish = "wall"
vertices = [[6,2,0],[6,2,3],[3,2,3],[3,2,0]]
[[surface]]
name = "inner-e"
finish = "wall"
vertices = [[3,2,0],[3,2,3],[3,4,3],[3,4,0]]
[[surface]]
name = "north"
finish = "wall"
vertices = [[3,4,0],[3,4,3],[0,4,3],[0,4,0]]
[[surface]]
name = "west"
finish = "wall"
vertices = [[0,4,0],[0,4,3],[0,0,3],[0,0,0]]
)";

}  // namespace

TEST_CASE("Furniture that stands, touches or hangs in the room is good", "[scene][placement][unit]") {
  CHECK(warnings_of(kDesk).empty());
  for (const char* corner : {"[0,0,0]", "[4.6,3.3,0]", "[4.6,0,2.28]", "[2,2,1]"}) {
    INFO(corner);
    CHECK(warnings_of(kDesk, {std::string("box.desk.corner=") + corner}).empty());
  }
  // A panel from wall to wall.
  CHECK(warnings_of(kRoom + "[[surface]]\nname = \"p\"\nfinish = \"wall\"\nsides = 2\n"
                            "vertices = [[3,0,0],[3,4,0],[3,4,3],[3,0,3]]\n")
            .empty());
}

TEST_CASE("Furniture outside the zone or through a wall is warned of with its line",
          "[scene][placement][unit]") {
  only(warnings_of(kDesk, {"box.desk.corner=[10,10,0]"}), "box 'desk' lies outside the zone", "is in m");
  only(warnings_of(kDesk, {"box.desk.corner=[5.5,1,0]"}), "box 'desk' goes through the zone's surfaces",
       "end it at the wall");
  only(warnings_of(kDesk, {"box.desk.corner=[5.5,1,0]", "box.desk.turn=30"}), "goes through",
       "every length is in m");
  // Larger than the room: every corner is outside, its middle not.
  only(warnings_of(
           kRoom +
           "[[box]]\nname = \"desk\"\nfinish = \"wall\"\ncorner = [-67,-33,-35]\nsize = [140,70,72]\n"),
       "box 'desk' goes through", "the size");
  only(warnings_of(kRoom + "[[surface]]\nname = \"p\"\nfinish = \"wall\"\nsides = 2\n"
                           "vertices = [[3,0,0],[3,5,0],[3,5,2],[3,0,2]]\n"),
       "surface 'p' goes through", "");
}

TEST_CASE("What goes through a wall ends at it: what lies outside does not count", "[scene][placement][unit]") {
  // The wall at x = 6, which is 4 x 3.
  const Zone straight = cut_off(kDesk, {"box.desk.corner=[5.5,1,0.5]"});
  CHECK(area_of(straight, "desk.top") == Approx(0.5 * 0.7).epsilon(1e-9));
  CHECK(area_of(straight, "desk.south") == Approx(0.5 * 0.72).epsilon(1e-9));
  CHECK(area_of(straight, "desk.west") == Approx(0.7 * 0.72).epsilon(1e-9));
  CHECK(area_of(straight, "desk.east") == 0.0);
  // Turned, only a corner is left outside.
  const Zone turned = cut_off(kDesk, {"box.desk.corner=[5.0,1,0.5]", "box.desk.turn=30"});
  CHECK(glm::length(open_area_m2(turned, {6, 4, 3})) < 1e-9);
  // A panel, on both sides.
  const Zone panel = cut_off(kRoom + "[[surface]]\nname = \"p\"\nfinish = \"wall\"\nsides = 2\n"
                                     "vertices = [[5,1,1],[7,1,1],[7,1,2],[5,1,2]]\n");
  CHECK(area_of(panel, "p") == Approx(1.0).epsilon(1e-9));
  CHECK(area_of(panel, "p.back") == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("What goes through an edge or a corner of the room ends at each of its walls", "[scene][placement][unit]") {
  const Zone edge = cut_off(kDesk, {"box.desk.corner=[5.5,3.6,0.5]"});
  CHECK(area_of(edge, "desk.top") == Approx(0.5 * 0.4).epsilon(1e-9));
  CHECK(area_of(edge, "desk.bottom") == Approx(0.5 * 0.4).epsilon(1e-9));
  CHECK(area_of(edge, "desk.south") == Approx(0.5 * 0.72).epsilon(1e-9));
  CHECK(area_of(edge, "desk.west") == Approx(0.4 * 0.72).epsilon(1e-9));
  CHECK(area_of(edge, "desk.east") == 0.0);
  CHECK(area_of(edge, "desk.north") == 0.0);
  CHECK(area_of(edge, "east") == Approx(4.0 * 3.0 - 0.4 * 0.72).epsilon(1e-9));
  CHECK(area_of(edge, "north") == Approx(6.0 * 3.0 - 0.5 * 0.72).epsilon(1e-9));
  const Zone corner = cut_off(kDesk, {"box.desk.corner=[5.5,3.6,2.7]"});
  CHECK(area_of(corner, "desk.bottom") == Approx(0.5 * 0.4).epsilon(1e-9));
  CHECK(area_of(corner, "desk.south") == Approx(0.5 * 0.3).epsilon(1e-9));
  CHECK(area_of(corner, "desk.west") == Approx(0.4 * 0.3).epsilon(1e-9));
  CHECK(area_of(corner, "desk.top") == 0.0);
  CHECK(area_of(corner, "ceiling") == Approx(24.0 - 0.2).epsilon(1e-9));
  for (const char* turn : {"10", "30", "45", "70"}) {
    INFO(turn);
    const Zone turned = cut_off(kRoom + box("[5.3,3.2,2.5]", "[1.4,0.7,0.72]", turn));
    CHECK(glm::length(open_area_m2(turned, {6, 4, 3})) < 1e-9);
  }
  const Zone panel = cut_off(kRoom + "[[surface]]\nname = \"p\"\nfinish = \"wall\"\nsides = 2\n"
                                     "vertices = [[5,3,1],[7,3,1],[7,5,1],[5,5,1]]\n");
  CHECK(area_of(panel, "p") == Approx(1.0).epsilon(1e-9));
  CHECK(area_of(panel, "p.back") == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("Furniture ends at walls in pieces and at opposite ones", "[scene][placement][unit]") {
  std::string pieces = kRoom;
  const std::string south = "vertices = [[0,0,0],[0,0,3],[6,0,3],[6,0,0]]";
  pieces.replace(pieces.find(south), south.size(), "vertices = [[0,0,0],[0,0,3],[2.5,0,3],[2.5,0,0]]");
  pieces += "[[surface]]\nname = \"south2\"\nfinish = \"wall\"\nvertices = [[2.5,0,0],[2.5,0,3],[6,0,3],[6,0,0]]\n";
  const Zone joint = cut_off(pieces + box("[2,-0.5,1]", "[1,1,1]"));
  CHECK(area_of(joint, "b.top") == Approx(0.5).epsilon(1e-9));
  CHECK(area_of(joint, "south") == Approx(7.0).epsilon(1e-9));
  CHECK(area_of(joint, "south2") == Approx(10.0).epsilon(1e-9));
  const Zone beam = cut_off(kRoom + box("[-1,1,2]", "[8,0.5,0.5]"));
  CHECK(area_of(beam, "b.top") == Approx(6.0 * 0.5).epsilon(1e-9));
  CHECK(area_of(beam, "east") == Approx(12.0 - 0.25).epsilon(1e-9));
  // All corners and the middle lie outside, and half the room is full.
  const Zone half = cut_off(kRoom + box("[3,-10,-10]", "[20,24,23]"));
  CHECK(area_of(half, "b.west") == Approx(12.0).epsilon(1e-9));
  CHECK(area_of(half, "east") == 0.0);
  CHECK(area_of(half, "floor") == Approx(12.0).epsilon(1e-9));
}

TEST_CASE("Furniture that the walls cannot end is kept whole, which is said", "[scene][placement][unit]") {
  const auto kept = [](const std::string& text) { return with_warning(text, {}, "kept whole"); };
  // The room's inner corner stands in the box, whose own corners all lie in the room.
  CHECK(area_of(kept(kAngle + box("[3.6,0.8,1]", "[0.6,2.5,0.5]", "45")), "b.top") == Approx(1.5).epsilon(1e-9));
  // Out of one wing and into the other.
  CHECK(area_of(kept(kAngle + box("[2.5,3,1]", "[2.5,0.3,0.5]", "-36.87")), "b.top") == Approx(0.75).epsilon(1e-9));
  // Larger than the room: nothing would be left of either.
  CHECK(area_of(kept(kRoom + box("[-67,-33,-35]", "[140,70,72]")), "b.top") == Approx(140.0 * 70.0).epsilon(1e-9));
}

TEST_CASE("Many pieces of furniture outside are one line", "[scene][placement][unit]") {
  std::string text =
      kRoom + "[[box]]\nname = \"d\"\nfinish = \"wall\"\ncorner = [20,1,0]\nsize = [1,0.5,0.5]\n";
  text += "[[copy]]\nof = \"d\"\ncount = [3,3]\npitch = [2,1]\n";
  only(warnings_of(text), "box 'd', box 'd[1,0]'", "is in m");
  CHECK(warnings_of(text)[0].find("and 4 more lie outside") != std::string::npos);
}

TEST_CASE("An external obstruction may stand outside", "[scene][placement][unit]") {
  CHECK(warnings_of(kRoom + "[[box]]\nname = \"tree\"\nfinish = \"wall\"\ncorner = [20,1,0]\nsize = [1,1,5]\n"
                            "outside = true\n")
            .empty());
}

TEST_CASE("An eye outside the zone or inside something is warned of at its line",
          "[scene][placement][unit]") {
  only(warnings_of(kDesk, {"view.door.eye=[1.2,1.2,0.4]"}),
       "view 'door': its eye (1.2, 1.2, 0.4) lies inside box 'desk'", "move the eye");
  only(warnings_of(kDesk, {"view.door.eye=[30,30,160]"}), "its eye (30, 30, 160) lies outside the zone",
       "is in m");
}

TEST_CASE("A zone of a size that no room has names the unit", "[scene][placement][unit]") {
  only(warnings_of(kRoom, {"unit=mm"}), "the zone measures 0.006 x 0.004 x 0.003 m",
       "is in mm: is it unit = \"m\"?");
  only(warnings_of(kRoom, {"unit=cm"}), "0.06 x 0.04 x 0.03 m", "is it unit = \"m\"?");
  CHECK(warnings_of(kRoom, {"unit=ft"}).empty());
  std::string thousands = kRoom;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"[[0,", "[[0,"},
                                 {"6,", "6000,"},
                                 {"4,", "4000,"},
                                 {",4]", ",4000]"},
                                 {",3]", ",3000]"}})
    for (std::size_t at = thousands.find(from, 140); at != std::string::npos;
         at = thousands.find(from, at + to.size()))
      thousands.replace(at, from.size(), to);
  only(warnings_of(thousands), "the zone measures 6000 x 4000 x 3000 m", "is it unit = \"mm\"?");
  // Large halls, stadiums and light boxes are none of our business.
  CHECK(warnings_of(kRoom, {"unit=in"}).size() == 1);  // 0.15 m
}
