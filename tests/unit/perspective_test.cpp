#include "geometry/perspective.hpp"

#include <random>

#include "base/error.hpp"
#include "catch.hpp"

using namespace dim;

TEST_CASE("The focus lies in the middle of the picture, the edge of the field of view on its border",
          "[geometry][perspective][unit]") {
  const Camera camera{{1, 2, 3}, {1, 7, 3}, {0, 0, 1}, radians(90), 800, 600};
  const Perspective view(camera);
  const auto focus = view.project(camera.focus);
  REQUIRE(focus);
  CHECK(focus->x == Approx(400));
  CHECK(focus->y == Approx(300));
  // Looking along +y, +x is right and +z up; at 45 degrees half the width.
  const auto right = view.project({6, 7, 3}), above = view.project({1, 7, 4});
  CHECK(right->x == Approx(800));
  CHECK(right->y == Approx(300));
  CHECK(above->x == Approx(400));
  CHECK(above->y == Approx(300 - 400.0 / 5));
  CHECK(view.depth_m({6, 7, 3}) == Approx(5));
  CHECK_FALSE(view.project({1, 1, 3}));
  CHECK_FALSE(view.project({1, 2.5, 3}, 1.0));
}

TEST_CASE("The ray through a point's pixel goes to the point", "[geometry][perspective][unit]") {
  const Perspective view({{0.3, -1.2, 2}, {4, 3, 0.5}, {0.1, 0.2, 1}, 1.1, 1280, 960});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Vec2 pixel(1280 * unit(random), 960 * unit(random));
    const Vec3 direction = view.direction(pixel.x, pixel.y);
    CHECK(glm::length(direction) == Approx(1.0).epsilon(1e-14));
    const auto back = view.project(view.eye() + 7.3 * direction);
    REQUIRE(back);
    CHECK(glm::length(*back - pixel) < 1e-9);
  }
}

TEST_CASE("A view straight down has +y up and +x right", "[geometry][perspective][unit]") {
  const Perspective plan({{2, 1, 9}, {2, 1, 0}, {0, 0, 1}, 1.0, 400, 400});
  CHECK(plan.project({3, 1, 0})->x > 200);
  CHECK(plan.project({2, 2, 0})->y < 200);
}

TEST_CASE("A segment is clipped to the picture and the near plane", "[geometry][perspective][unit]") {
  const Perspective view({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, radians(90), 100, 100});
  const auto across = view.clip({-2, 1, 0}, {2, 1, 0}, 0.1);
  REQUIRE(across);
  CHECK(across->first == Approx(0.25));
  CHECK(across->second == Approx(0.75));
  const auto from_behind = view.clip({0, -1, 0}, {0, 3, 0}, 0.2);
  REQUIRE(from_behind);
  CHECK(from_behind->first == Approx(0.3));
  CHECK(from_behind->second == 1.0);
  CHECK_FALSE(view.clip({-2, 1, 0}, {-1.5, 1, 0}, 0.1));
  CHECK_FALSE(view.clip({-2, 0.5, 0}, {0.5, -2, 0}, 0.1));
}

TEST_CASE("A camera that sees nothing is refused", "[geometry][perspective][unit]") {
  CHECK_THROWS_AS(Perspective({{1, 1, 1}, {1, 1, 1}}), InternalError);
  CHECK_THROWS_AS(Perspective({{0, 0, 0}, {1, 1, 1}, {0, 0, 1}, kPi}), InternalError);
}

TEST_CASE("A parallel view is to scale whatever the depth, and begins at the eye",
          "[geometry][perspective][unit]") {
  Camera camera{{2, 1, 9}, {2, 1, 0}, {0, 0, 1}};
  camera.width = 400, camera.height = 300;
  camera.parallel_m = 8.0;
  const Perspective plan(camera);
  for (const double z : {8.0, 0.0, -50.0}) {
    const auto place = plan.project({3, 2, z});
    REQUIRE(place);
    CHECK(place->x == Approx(250.0));
    CHECK(place->y == Approx(100.0));
  }
  CHECK_FALSE(plan.project({3, 2, 9.5}));
  CHECK(glm::length(plan.origin(250, 100) - Vec3(3, 2, 9)) < 1e-12);
  CHECK(plan.direction(7, 8) == Vec3(0, 0, -1));
  CHECK(plan.origin_towards({3, 2, 1}) == Vec3(3, 2, 9));
  const auto shown = plan.clip({-10, 1, 0}, {10, 1, 0}, 1e-6);
  REQUIRE(shown);
  CHECK(-10.0 + 20.0 * shown->first == Approx(-2.0));
  CHECK(-10.0 + 20.0 * shown->second == Approx(6.0));
}
