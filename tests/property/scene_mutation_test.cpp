#include <random>

#include "../unit/scene_support.hpp"
#include "scene/lights_reader.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kZone = kRoom + R"([[surface]]
name = "window"
finish = "glass"
on = "south"
vertices = [[1,0,1],[1,0,2],[3,0,2],[3,0,1]]
[[surface]]
name = "panel"
finish = "wall"
sides = 2
holes = [[[4.2,1,0.2],[4.4,1,0.2],[4.4,1,0.4]]]
vertices = [[4,1,0],[5,1,0],[5,1,1],[4,1,1]]
[[box]]
name = "desk"
finish = "dark"
corner = [1,1,0]
size = [1.2,0.6,0.75]
turn = 30
[[copy]]
of = "desk"
names = ["desk2"]
by = [[2,1,0]]
[[plane]]
name = "work"
vertices = [[0.5,0.5,0.8],[5.5,0.5,0.8],[5.5,3.5,0.8],[0.5,3.5,0.8]]
spacing = 0.5
[[sensors]]
name = "eyes"
points = [[1,1,1, 0,0,1]]
[site]
latitude = 55.86
[[view]]
name = "door"
eye = [0.3,0.3,1.6]
focus = [5,3,0.8]
fov = 70
size = [640, 480]
)";

const std::string kLights = R"(dim = "lights/1"
[[luminaire]]
name = "A"
ideal = "lambertian"
intensity = 100
at = [1.2,1.2,2.75]
aim = [0.1,0,-1]
c0 = [0,1,0]
turn = 15
opening = [0.6, 0.3]
body = true
count = [2,2]
pitch = [1.5,1.5]
spectrum = [[400,1],[700,2]]
[[luminaire]]
name = "B"
group = "row"
ideal = "isotropic"
lumens = 1000
dim = 0.5
at = [2,2,2]
)";

// Changes of the kind that editing, copying and damage make.
std::string mutated(const std::string& text, std::mt19937& random) {
  static const std::vector<std::string> kPieces = {
      "nan",
      "inf",
      "-1",
      "1e308",
      "1e-320",
      "0",
      "[[",
      "]]",
      "[",
      "]",
      "\"",
      "=",
      "#",
      "\n",
      "\xff",
      "'",
      "{",
      "}",
      ",",
      ".",
      "true",
      "99999999999",
      "\"\"",
      "1979-05-27",
      "[1,2]",
      "[[0,0,0]]",
      "name",
      "on = \"desk.top\"\n",
      "[[copy]]\nof = \"panel\"\nnames = [\"p\"]\nby = [[0,0,0]]\n"};
  std::string result = text;
  const int n = 1 + static_cast<int>(random() % 4);
  for (int i = 0; i < n && !result.empty(); ++i) {
    const std::size_t at = random() % result.size();
    const std::size_t length = std::min<std::size_t>(result.size() - at, random() % 12);
    switch (random() % 12) {
      case 0:
        result.erase(at, length);
        break;
      case 1:
        result.insert(at, kPieces[random() % kPieces.size()]);
        break;
      case 2:
        result.replace(at, length, kPieces[random() % kPieces.size()]);
        break;
      case 3:
        result.insert(at, result.substr(random() % result.size(), random() % 80));
        break;
      case 4:
        result[at] = static_cast<char>(random() % 256);
        break;
      default: {
        // A digit for a digit, so that the text stays TOML and the geometry goes wrong.
        const auto digit = result.find_first_of("0123456789", at);
        if (digit != std::string::npos) result[digit] = static_cast<char>('0' + random() % 10);
      }
    }
  }
  return result;
}

void check_sound(const Zone& zone) {
  const int n = static_cast<int>(zone.surfaces.size());
  for (const auto& surface : zone.surfaces) {
    REQUIRE(surface.polygon.area_m2() > 0.0);
    REQUIRE(std::isfinite(surface.polygon.area_m2()));
    REQUIRE(surface.finish >= 0);
    REQUIRE(surface.finish < static_cast<int>(zone.finishes.size()));
    REQUIRE(surface.parent < n);
    REQUIRE(surface.twin < n);
    REQUIRE(surface.cell_m > 0.0);
  }
  for (const auto& set : zone.point_sets) REQUIRE(set.first + set.count <= zone.points.size());
}

}  // namespace

TEST_CASE("A damaged zone file is read soundly or refused", "[scene][property][stress]") {
  std::mt19937 random(20250101);
  REQUIRE(problems_of(kZone, {"finishes.wall=0.3"}).size() ==
          1);  // the finish 'glass' is missing: begin broken
  const std::string valid =
      std::string(kZone).insert(kZone.find("dark ="), "glass = { transmittance = 0.8 }\n");
  REQUIRE(problems_of(valid).empty());
  int n_read = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = mutated(valid, random);
    INFO("mutation " << i);
    try {
      Warnings warnings;
      check_sound(read_zone(text, "z.toml", {}, 0.0, {}, warnings));
      ++n_read;
    } catch (const InputError& error) {
      REQUIRE_FALSE(error.problems().empty());
    }
  }
  CHECK(n_read > 100);
}

TEST_CASE("A damaged lights file is read soundly or refused", "[scene][lights][property][stress]") {
  std::mt19937 random(42);
  Warnings ignored;
  const Zone zone = read(kRoom);
  const auto load = [](const std::string& path) -> std::string { throw IoError(path, "not here"); };
  CHECK(read_lights(kLights, "l.toml", {}, zone, {}, ignored, load).luminaires.size() == 5);
  int n_read = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = mutated(kLights, random);
    INFO("mutation " << i);
    try {
      const Lights lights = read_lights(text, "l.toml", {}, zone, {}, ignored, load);
      for (const auto& luminaire : lights.luminaires) {
        REQUIRE(std::isfinite(luminaire.factor));
        REQUIRE(std::abs(glm::length(luminaire.c90) - 1.0) < 1e-12);
        REQUIRE(std::abs(glm::dot(luminaire.c0, luminaire.aim)) < 1e-12);
        REQUIRE(luminaire.fitting < static_cast<int>(lights.fittings.size()));
      }
      ++n_read;
    } catch (const InputError& error) {
      REQUIRE_FALSE(error.problems().empty());
    }
  }
  CHECK(n_read > 100);
}
