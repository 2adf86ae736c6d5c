#include "geometry/polygon.hpp"

#include "catch.hpp"

using namespace dim;

TEST_CASE("A rectangle's frame has u along its longest edge and the origin at its corner",
          "[geometry][unit]") {
  const Polygon floor({{0, 0, 0}, {2, 0, 0}, {2, 5, 0}, {0, 5, 0}});
  CHECK(floor.size_m().x == Approx(5));
  CHECK(floor.size_m().y == Approx(2));
  CHECK(floor.area_m2() == Approx(10));
  CHECK(glm::length(floor.normal() - Vec3(0, 0, 1)) < 1e-15);
  CHECK(floor.is_rectangle());
  CHECK(glm::length(floor.centroid() - Vec3(1, 2.5, 0)) < 1e-14);
}

TEST_CASE("The frame does not depend on the corner a ring starts at", "[geometry][unit]") {
  const Ring3 ring = {{1, 2, 3}, {4, 2, 3}, {4, 2, 5}, {1, 2, 5}};
  const Polygon first(ring);
  for (std::size_t start = 1; start < 4; ++start) {
    Ring3 turned;
    for (std::size_t i = 0; i < 4; ++i) turned.push_back(ring[(start + i) % 4]);
    const Polygon polygon(turned);
    CHECK(glm::length(polygon.frame().u - first.frame().u) < 1e-14);
    CHECK(glm::length(polygon.frame().origin - first.frame().origin) < 1e-13);
  }
}

TEST_CASE("Holes take area away and are outside, whichever way they run", "[geometry][unit]") {
  const Ring3 outline = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  Ring3 hole = {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  for (int turn = 0; turn < 2; ++turn) {
    const Polygon polygon(outline, {hole});
    CHECK(polygon.area_m2() == Approx(11));
    CHECK_FALSE(polygon.contains({1.5, 1.5}));
    CHECK(polygon.contains({0.5, 0.5}));
    CHECK(polygon.contains({1.0 + 1e-9, 1.5}, 1e-8));
    CHECK_FALSE(polygon.is_rectangle());
    std::reverse(hole.begin(), hole.end());
  }
}

TEST_CASE("Reversing a polygon keeps its area and centroid and turns its normal", "[geometry][unit]") {
  const Polygon polygon({{0, 0, 0}, {4, 0, 0}, {4, 1, 1}, {2, 3, 3}, {0, 1, 1}});
  const Polygon back = polygon.reversed();
  CHECK(back.area_m2() == Approx(polygon.area_m2()).epsilon(1e-14));
  CHECK(glm::length(back.normal() + polygon.normal()) < 1e-15);
  CHECK(glm::length(back.centroid() - polygon.centroid()) < 1e-14);
  CHECK(glm::length(glm::cross(back.frame().u, back.frame().v) - back.normal()) < 1e-14);
}

TEST_CASE("An L-shaped polygon does not contain its notch", "[geometry][unit]") {
  const Polygon polygon({{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}});
  CHECK(polygon.area_m2() == Approx(16));
  CHECK(polygon.contains({1, 3}));
  CHECK_FALSE(polygon.contains({4, 3}));
  CHECK(polygon.contains({2.0, 3.0}, 1e-9));
}

TEST_CASE("A millimetre triangle a thousand kilometres away keeps its area", "[geometry][unit]") {
  const Vec3 far(1e6, -1e6, 1e6);
  const Polygon polygon({far, far + Vec3(1e-3, 0, 0), far + Vec3(0, 1e-3, 0)});
  CHECK(polygon.area_m2() == Approx(5e-7).epsilon(1e-6));
}
