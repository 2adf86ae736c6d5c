#include "geometry/fisheye.hpp"

#include "catch.hpp"

using namespace dim;

namespace {

const Vec3 kEye(1, 2, 3);

Fisheye along_y(FisheyeLaw law, int side_px = 400) { return {kEye, {0, 1, 0}, {0, 0, 1}, law, side_px}; }

// Turned from the view by `angle`, round it by `round` from the right upwards.
Vec3 at(double angle, double round, double distance_m) {
  return kEye + distance_m * Vec3(std::sin(angle) * std::cos(round), std::cos(angle), std::sin(angle) * std::sin(round));
}

}  // namespace

TEST_CASE("An angular fisheye shows an angle at its share of 90 degrees, a hemispherical one at its sine",
          "[geometry][fisheye][unit]") {
  const Fisheye angular = along_y(FisheyeLaw::angular), hemispherical = along_y(FisheyeLaw::hemispherical);
  for (const double angle_deg : {0.0, 1e-6, 15.0, 45.0, 60.0, 89.0, 90.0})
    for (const double round : {0.0, 0.7, 2.0, 4.5})
      for (const double distance_m : {0.01, 3.0, 1000.0}) {
        const double angle = radians(angle_deg);
        const Vec2 way(std::cos(round), -std::sin(round));  // y runs downwards
        const auto p = angular.project(at(angle, round, distance_m)), q = hemispherical.project(at(angle, round, distance_m));
        if (angle_deg == 90.0 && !p) continue;  // on the rim, rounding decides
        REQUIRE(p);
        REQUIRE(q);
        CHECK(glm::length(*p - (Vec2(200) + 200.0 * (angle_deg / 90.0) * way)) < 1e-9);
        CHECK(glm::length(*q - (Vec2(200) + 200.0 * std::sin(angle) * way)) < 1e-9);
      }
  CHECK_FALSE(angular.project(at(radians(91), 0.0, 1.0)));
  CHECK_FALSE(angular.project(kEye));
}

TEST_CASE("The ray through a fisheye's pixel goes to what is shown there, and there is none outside its circle",
          "[geometry][fisheye][unit]") {
  const auto law = GENERATE(FisheyeLaw::angular, FisheyeLaw::hemispherical);
  const Fisheye fisheye = along_y(law, 101);
  int n_outside = 0;
  for (int j = 0; j < 101; ++j)
    for (int i = 0; i < 101; ++i) {
      const Vec2 place(i + 0.5, j + 0.5);
      const auto direction = fisheye.direction(place.x, place.y);
      CHECK(direction.has_value() == (glm::length(place - Vec2(50.5)) < 50.5));
      if (!direction) {
        ++n_outside;
        continue;
      }
      CHECK(glm::length(*direction) == Approx(1.0).epsilon(1e-14));
      const auto back = fisheye.project(kEye + 5.0 * *direction);
      REQUIRE(back);
      CHECK(glm::length(*back - place) < 1e-9);
    }
  CHECK(n_outside > 0);
}

TEST_CASE("A fisheye's pixels add up to the hemisphere, and hemispherical ones bring equal illuminance",
          "[geometry][fisheye][unit]") {
  constexpr int kSide = 500;
  const Fisheye angular = along_y(FisheyeLaw::angular, kSide), hemispherical = along_y(FisheyeLaw::hemispherical, kSide);
  double sum_sr = 0.0, projected_sr = 0.0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = i + 0.5, y = j + 0.5;
      if (!angular.direction(x, y)) continue;
      sum_sr += angular.solid_angle_sr(x, y);
      const double cosine = hemispherical.direction(x, y)->y;
      projected_sr += cosine * hemispherical.solid_angle_sr(x, y);
      CHECK(cosine * hemispherical.solid_angle_sr(x, y) == Approx(4.0 / (kSide * kSide)).epsilon(1e-9));
    }
  CHECK(sum_sr == Approx(2.0 * kPi).epsilon(1e-3));
  CHECK(projected_sr == Approx(kPi).epsilon(1e-3));
}
