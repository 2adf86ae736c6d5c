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
  const auto area_of = [](const Zone& zone, const std::string& name) {
    double sum = 0.0;
    for (const auto& surface : zone.surfaces)
      if (surface.name == name) sum += surface.polygon.area_m2();
    return sum;
  };
  const auto zone_with = [](const std::string& text, const std::vector<std::string>& overrides) {
    Warnings warnings;
    const Zone zone = read(text, overrides, &warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].what.find("the part outside is cut off") != std::string::npos);
    return zone;
  };
  // The wall at x = 6, which is 4 x 3.
  const Zone straight = zone_with(kDesk, {"box.desk.corner=[5.5,1,0.5]"});
  CHECK(area_of(straight, "desk.top") == Approx(0.5 * 0.7).epsilon(1e-9));
  CHECK(area_of(straight, "desk.south") == Approx(0.5 * 0.72).epsilon(1e-9));
  CHECK(area_of(straight, "desk.west") == Approx(0.7 * 0.72).epsilon(1e-9));
  CHECK(area_of(straight, "desk.east") == 0.0);
  // Turned, only a corner is left outside. What remains of its faces and the wall's loss close it: their areas
  // add up to nothing as vectors.
  const Zone turned = zone_with(kDesk, {"box.desk.corner=[5.0,1,0.5]", "box.desk.turn=30"});
  Vec3 sum(0.0);
  double wall_m2 = 0.0;
  for (const auto& surface : turned.surfaces) {
    if (surface.name.starts_with("desk.")) sum += surface.polygon.area_m2() * surface.polygon.normal();
    if (surface.polygon.normal().x < -0.999 && surface.bounding) wall_m2 += surface.polygon.area_m2();
  }
  CHECK(wall_m2 < 12.0 - 0.1);
  CHECK(glm::length(sum + Vec3(12.0 - wall_m2, 0, 0)) < 1e-9);
  // A panel, on both sides.
  const Zone panel = zone_with(kRoom + "[[surface]]\nname = \"p\"\nfinish = \"wall\"\nsides = 2\n"
                                       "vertices = [[5,1,1],[7,1,1],[7,1,2],[5,1,2]]\n",
                               {});
  CHECK(area_of(panel, "p") == Approx(1.0).epsilon(1e-9));
  CHECK(area_of(panel, "p.back") == Approx(1.0).epsilon(1e-9));
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
