#include <algorithm>
#include <cmath>

#include "scene/lights_reader.hpp"
#include "scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

Lights lights(const std::string& more, Warnings* warnings = nullptr) {
  Warnings own;
  const Zone zone = read(kRoom);
  return read_lights(
      "dim = \"lights/1\"\n[[luminaire]]\nname = \"A\"\nideal = \"lambertian\"\nlumens = 100\n" + more,
      "l.toml", {}, zone, {}, warnings ? *warnings : own);
}

// In the file's coordinates: the room of 6 x 4 x 3 is centred.
Vec3 at(const Lights& lights, std::size_t i) { return lights.luminaires.at(i).at + Vec3(3, 2, 1.5); }

bool near(const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-12; }

std::string problem(const std::string& more) {
  try {
    lights(more);
  } catch (const InputError& error) {
    return to_string(error.problems().front());
  }
  return {};
}

std::string said(const Warnings& warnings) {
  std::string all;
  for (const auto& warning : warnings) all += to_string(warning) + "\n";
  return all;
}

}  // namespace

TEST_CASE("A field runs along the luminaire's own axes, or any", "[scene][lights][unit]") {
  const std::string field = "at = [1,1,2]\ncount = [2,2]\npitch = [0.5,0.25]\n";
  // c0 = (1,1)/sqrt2, aim down: C90 = c0 x aim = (-1,1)/sqrt2 turned right: (-s, s).
  const auto own = lights(field + "c0 = [1,1,0]\nalong = \"own\"\n");
  const double s = std::sqrt(0.5);
  REQUIRE(own.luminaires.size() == 4);
  CHECK(own.luminaires[1].name == "A[1,0]");
  CHECK(near(at(own, 1), Vec3(1, 1, 2) + 0.5 * Vec3(s, s, 0)));
  CHECK(near(at(own, 2), Vec3(1, 1, 2) + 0.25 * own.luminaires[0].c90));
  const auto any = lights(field + "along = [[0,2,0],[0,0,-3]]\n");
  CHECK(near(at(any, 1), Vec3(1, 1.5, 2)));
  CHECK(near(at(any, 3), Vec3(1, 1.5, 1.75)));
  CHECK(problem(field + "along = [[1,0,0]]\n").find("along must be two directions, not 1") !=
        std::string::npos);
  CHECK(problem(field + "along = \"owm\"\n").find("did you mean 'own'") != std::string::npos);
}

TEST_CASE("A line of luminaires runs from end to end, both included", "[scene][lights][unit]") {
  const auto line = lights("line = { from = [1,1,2], to = [4,2.5,2], count = 4 }\n");
  REQUIRE(line.luminaires.size() == 4);
  CHECK(line.luminaires[3].name == "A[3]");
  CHECK(near(at(line, 0), {1, 1, 2}));
  CHECK(near(at(line, 1), {2, 1.5, 2}));
  CHECK(near(at(line, 3), {4, 2.5, 2}));
  CHECK(
      problem("at = [1,1,1]\nline = { from = [1,1,2], to = [4,2.5,2], count = 4 }\n").find("leave out at") !=
      std::string::npos);
  CHECK(problem("line = { from = [1,1,2], to = [4,2.5,2], count = 1 }\n").find("count must be 2 to") !=
        std::string::npos);
  CHECK(problem("line = { from = [1,1,2], to = [9,2.5,2], count = 3 }\n")
            .find("'A[2]' at (9, 2.5, 2) is outside") != std::string::npos);
}

TEST_CASE("A ring of luminaires turns each with its place", "[scene][lights][unit]") {
  const auto ring = lights("at = [3,2,2]\naim = [1,0,-1]\nring = { radius = 1, count = 4, start = 90 }\n");
  REQUIRE(ring.luminaires.size() == 4);
  CHECK(near(at(ring, 0), {3, 3, 2}));
  CHECK(near(at(ring, 1), {2, 2, 2}));
  const double s = std::sqrt(0.5);
  // Aimed outwards and down wherever it stands.
  CHECK(near(ring.luminaires[0].aim, {0, s, -s}));
  CHECK(near(ring.luminaires[1].aim, {-s, 0, -s}));
  for (const auto& luminaire : ring.luminaires) {
    CHECK(near(luminaire.c90, glm::cross(luminaire.c0, luminaire.aim)));
    CHECK(std::abs(glm::dot(luminaire.c0, luminaire.aim)) < 1e-12);
  }
  CHECK(problem("at = [3,2,2]\ncount = [2,2]\npitch = [1,1]\nring = { radius = 1, count = 4 }\n")
            .find("only one of count and pitch, line, and ring") != std::string::npos);
}

TEST_CASE("A dim factor above 2 is warned of, per cent are understood", "[scene][lights][unit]") {
  Warnings warnings;
  CHECK(lights("at = [3,2,2]\ndim = \"30 %\"\n", &warnings).luminaires[0].factor ==
        Approx(lights("at = [3,2,2]\ndim = 0.3\n").luminaires[0].factor));
  CHECK(warnings.empty());
  lights("at = [3,2,2]\ndim = 30\n", &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(to_string(warnings[0]) ==
        "l.toml:7:7: luminaire 'A': dim = 30 is 30 times the full flux\n        in percent? write dim = 0.3, "
        "or \"30 "
        "%\"");
}

TEST_CASE("A room is six named surfaces that face into it", "[scene][unit]") {
  Warnings warnings;
  const Zone zone = read(R"(dim = "zone/1"
[finishes]
wall = "50 %"
dark = 0.2
[[room]]
size = [6, 4]
height = 3
corner = [1, 1, 0]
turn = 90
floor = "dark"
walls = "wall"
wall-n = "dark"
ceiling = "wall"
[[surface]]
name = "picture"
finish = "dark"
on = "wall-s"
vertices = [[1,2,1],[1,2,2],[1,3,2],[1,3,1]]
)",
                         {}, &warnings);
  CHECK(said(warnings).empty());
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(72.0));
  REQUIRE(find(zone, "wall-e") != nullptr);
  CHECK(area_of(zone, "wall-e") == Approx(12.0));
  // Turned by a quarter: the wall that was -y looks along -x now.
  CHECK(near(find(zone, "wall-s")->polygon.normal(), {-1, 0, 0}));
  CHECK(area_of(zone, "wall-s") == Approx(18.0 - 1.0));
  CHECK(zone.finishes[static_cast<std::size_t>(find(zone, "wall-n")->finish)].name == "dark");
}

TEST_CASE("A copied grid leaves the original where it is", "[scene][unit]") {
  const Zone zone = read(kRoom + R"([[box]]
name = "desk"
finish = "wall"
corner = [0.5,0.5,0.2]
size = [1,0.5,0.5]
[[copy]]
of = "desk"
count = [2, 2]
pitch = [2, 1.5]
)");
  CHECK(area_of(zone, "desk.top") == Approx(0.5));
  const auto* far = find(zone, "desk[1,1].top");
  REQUIRE(far != nullptr);
  CHECK(near(far->polygon.centroid() + zone.origin_m, {0.5 + 2 + 0.5, 0.5 + 1.5 + 0.25, 0.7}));
  CHECK(zone.surfaces.size() == 6 + 4 * 6);
}

TEST_CASE("A group is copied as a whole: turned, mirrored, its features on its own parents",
          "[scene][unit]") {
  const std::string group = kRoom + R"([[box]]
name = "desk"
finish = "wall"
corner = [1,1,0.2]
size = [1,0.5,0.5]
[[box]]
name = "drawer"
finish = "dark"
corner = [1,1,0.1]
size = [0.25,0.5,0.1]
[[surface]]
name = "pad"
finish = "dark"
on = "desk.top"
vertices = [[1.1,1.1,0.7],[1.3,1.1,0.7],[1.3,1.3,0.7],[1.1,1.3,0.7]]
[[copy]]
of = ["desk", "drawer", "pad"]
names = ["b"]
)";
  Warnings warnings;
  const Zone mirrored = read(group + "mirror = \"x\"\nby = [[2,0,0]]\n", {}, &warnings);
  CHECK(said(warnings).empty());
  // About the middle of the desk, x = 1.5: the drawer comes to the right end, the pad with it.
  CHECK(near(find(mirrored, "b.drawer.bottom")->polygon.centroid() + mirrored.origin_m, {3.875, 1.25, 0.1}));
  CHECK(near(find(mirrored, "b.pad")->polygon.centroid() + mirrored.origin_m, {3.8, 1.2, 0.7}));
  CHECK(near(find(mirrored, "b.pad")->polygon.normal(), {0, 0, 1}));
  CHECK(area_of(mirrored, "b.desk.top") == Approx(0.5 - 0.04));
  // A face keeps its name and looks out of the box still.
  const auto* east = find(mirrored, "b.desk.east");
  CHECK(near(east->polygon.normal(), {-1, 0, 0}));

  const Zone turned = read(group + "turn = 180\nabout = [3, 2]\n");
  CHECK(near(find(turned, "b.drawer.bottom")->polygon.centroid() + turned.origin_m, {4.875, 2.75, 0.1}));
  CHECK(near(find(turned, "b.pad")->polygon.centroid() + turned.origin_m, {4.8, 2.8, 0.7}));
  CHECK(area_of(turned, "b.desk.top") == Approx(area_of(turned, "desk.top")));

  CHECK(problems_of(group + "about = [1,1]\nby = [[1,0,0]]\n")[0].find(
            "about is what turn and mirror go by") != std::string::npos);
  CHECK(
      problems_of(kRoom + "[[copy]]\nof = [\"floor\", \"desk\"]\nnames = [\"b\"]\nby = [[0,0,1]]\n")[0].find(
          "no surface or box 'desk' above") != std::string::npos);
}
