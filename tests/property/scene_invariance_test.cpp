#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "../unit/scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

struct Face {
  std::string name;
  std::string extra;
  Ring3 ring;
};

// The room with a cabinet in a corner, a window with a pane, a panel and a column through floor and ceiling.
std::vector<Face> room_faces() {
  return {{"floor", "", {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}}},
          {"ceiling", "", {{0, 0, 3}, {0, 4, 3}, {6, 4, 3}, {6, 0, 3}}},
          {"south", "", {{0, 0, 0}, {0, 0, 3}, {6, 0, 3}, {6, 0, 0}}},
          {"north", "", {{0, 4, 0}, {6, 4, 0}, {6, 4, 3}, {0, 4, 3}}},
          {"west", "", {{0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}}},
          {"east", "", {{6, 0, 0}, {6, 0, 3}, {6, 4, 3}, {6, 4, 0}}},
          {"window", "on = \"south\"\n", {{1, 0, 1}, {1, 0, 2.25}, {3, 0, 2.25}, {3, 0, 1}}},
          {"pane", "on = \"window\"\n", {{1.1, 0, 1.1}, {1.1, 0, 2}, {2.9, 0, 2}, {2.9, 0, 1.1}}},
          {"panel", "sides = 2\n", {{4, 1, 0}, {4, 2.5, 0}, {4, 2.5, 1.5}, {4, 1, 1.5}}}};
}

std::string number(double x) { return fmt::format("{:.17g}", x); }

// Written in another unit, from another place, turned about the vertical by a right angle or not at all.
std::string written(const std::vector<Face>& faces, const std::string& unit, double units_per_m,
                    const Vec3& shift_m, bool boxes_first = false) {
  const auto point = [&](const Vec3& p) {
    const Vec3 q = (p + shift_m) * units_per_m;
    return "[" + number(q.x) + "," + number(q.y) + "," + number(q.z) + "]";
  };
  const auto length = [&](double x) { return number(x * units_per_m); };
  std::string text =
      "dim = \"zone/1\"\nunit = \"" + unit + "\"\ncell = " + length(0.5) + "\n[finishes]\nw = 0.5\n";
  const std::string boxes =
      "[[box]]\nname = \"cabinet\"\nfinish = \"w\"\ncorner = " + point({5, 3.5, 0}) + "\nsize = [" +
      length(1) + "," + length(0.5) + "," + length(2) + "]\n" +
      "[[box]]\nname = \"column\"\nfinish = \"w\"\nturn = 30\ncorner = " + point({2, 2, 0}) + "\nsize = [" +
      length(0.3) + "," + length(0.4) + "," + length(3) + "]\n";
  if (boxes_first) text += boxes;
  for (const auto& face : faces) {
    text += "[[surface]]\nname = \"" + face.name + "\"\nfinish = \"w\"\n" + face.extra + "vertices = [";
    for (const auto& p : face.ring) text += point(p) + ",";
    text += "]\n";
  }
  return boxes_first ? text : text + boxes;
}

void check_same(const Zone& zone, const Zone& expected, double tolerance) {
  REQUIRE(zone.surfaces.size() == expected.surfaces.size());
  CHECK(zone.closed == expected.closed);
  CHECK(zone.volume_m3 == Approx(expected.volume_m3).epsilon(tolerance));
  CHECK(zone.diameter_m == Approx(expected.diameter_m).epsilon(tolerance));
  for (const auto& surface : expected.surfaces) {
    INFO(surface.name);
    const Surface* same = find(zone, surface.name);
    REQUIRE(same != nullptr);
    CHECK(same->polygon.area_m2() == Approx(surface.polygon.area_m2()).epsilon(tolerance));
    CHECK(glm::length(same->polygon.centroid() - surface.polygon.centroid()) < 10 * tolerance);
    CHECK(glm::length(same->polygon.normal() - surface.polygon.normal()) < 10 * tolerance);
    CHECK(same->polygon.rings().size() == surface.polygon.rings().size());
    CHECK(same->cell_m == Approx(surface.cell_m).epsilon(tolerance));
  }
}

}  // namespace

TEST_CASE("The furnished room has the areas that arithmetic gives", "[scene][property]") {
  const Zone zone = read(written(room_faces(), "m", 1, Vec3(0)));
  CHECK(zone.closed);
  CHECK(zone.volume_m3 == Approx(72).epsilon(1e-13));
  CHECK(area_of(zone, "floor") == Approx(24 - 0.5 - 0.12).epsilon(1e-12));
  CHECK(area_of(zone, "ceiling") == Approx(24 - 0.12).epsilon(1e-12));
  CHECK(area_of(zone, "south") == Approx(18 - 2.5).epsilon(1e-12));
  CHECK(area_of(zone, "window") == Approx(2.5 - 1.8 * 0.9).epsilon(1e-12));
  CHECK(area_of(zone, "north") == Approx(18 - 2).epsilon(1e-12));
  CHECK(area_of(zone, "east") == Approx(12 - 1).epsilon(1e-12));
  CHECK(area_of(zone, "panel.back") == Approx(2.25).epsilon(1e-12));
  CHECK(find(zone, "column.top") == nullptr);
}

TEST_CASE("The zone is the same from any first corner and in any order", "[scene][property]") {
  const Zone expected = read(written(room_faces(), "m", 1, Vec3(0)));
  std::mt19937 random(4711);
  for (int i = 0; i < 20; ++i) {
    auto faces = room_faces();
    std::shuffle(faces.begin(), faces.end(), random);
    for (auto& face : faces)
      std::rotate(face.ring.begin(), face.ring.begin() + static_cast<int>(random() % 4), face.ring.end());
    check_same(read(written(faces, "m", 1, Vec3(0), i % 2 == 0)), expected, 1e-12);
  }
}

TEST_CASE("The zone is the same in metres, millimetres, centimetres, inches and feet", "[scene][property]") {
  const Zone expected = read(written(room_faces(), "m", 1, Vec3(0)));
  check_same(read(written(room_faces(), "mm", 1000, Vec3(0))), expected, 1e-12);
  check_same(read(written(room_faces(), "cm", 100, Vec3(0))), expected, 1e-12);
  check_same(read(written(room_faces(), "in", 1 / 0.0254, Vec3(0))), expected, 1e-12);
  check_same(read(written(room_faces(), "ft", 1 / 0.3048, Vec3(0))), expected, 1e-12);
}

TEST_CASE("The zone is the same a thousand kilometres away", "[scene][property]") {
  // A coordinate of 1e6 m carries 1.2e-10 m.
  const Zone expected = read(written(room_faces(), "m", 1, Vec3(0)));
  check_same(read(written(room_faces(), "m", 1, Vec3(1e6, -1e6, 1e6))), expected, 1e-9);
  check_same(read(written(room_faces(), "ft", 1 / 0.3048, Vec3(-1e6, 1e6, 3e5))), expected, 1e-9);
  const Zone far = read(written(room_faces(), "m", 1, Vec3(1e6, -1e6, 1e6)));
  CHECK(glm::length(far.origin_m - Vec3(1e6 + 3, -1e6 + 2, 1e6 + 1.5)) < 1e-9);
}

TEST_CASE("Rooms of a micrometre and of a thousand kilometres are the same room", "[scene][property]") {
  const Zone expected = read(written(room_faces(), "m", 1, Vec3(0)));
  for (const double scale : {1e-6, 1e6}) {
    const Zone zone = read(written(room_faces(), "m", scale, Vec3(0)));
    REQUIRE(zone.surfaces.size() == expected.surfaces.size());
    CHECK(zone.closed);
    CHECK(zone.volume_m3 == Approx(72 * scale * scale * scale).epsilon(1e-12));
    for (std::size_t i = 0; i < zone.surfaces.size(); ++i)
      CHECK(zone.surfaces[i].polygon.area_m2() ==
            Approx(expected.surfaces[i].polygon.area_m2() * scale * scale).epsilon(1e-11));
  }
}

TEST_CASE("A room turned about a skew axis keeps its areas and stays closed", "[scene][property]") {
  std::mt19937 random(99);
  std::normal_distribution<double> any;
  const Zone expected = read(written(room_faces(), "m", 1, Vec3(0)));
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis = glm::normalize(Vec3(any(random), any(random), any(random)));
    const double angle = any(random) * 2, c = std::cos(angle), s = std::sin(angle);
    auto faces = room_faces();
    for (auto& face : faces)
      for (auto& p : face.ring) p = c * p + s * glm::cross(axis, p) + (1 - c) * glm::dot(axis, p) * axis;
    std::string text = written(faces, "m", 1, Vec3(0));
    text.resize(text.find("[[box]]"));  // boxes stand upright
    const Zone zone = read(text);
    CHECK(zone.closed);
    CHECK(zone.volume_m3 == Approx(72).epsilon(1e-12));
    for (const char* name : {"south", "window", "pane", "panel.back"})
      CHECK(area_of(zone, name) == Approx(area_of(expected, name)).epsilon(1e-11));
    // The cabinet took these from floor and walls.
    CHECK(area_of(zone, "east") == Approx(12).epsilon(1e-12));
  }
}
