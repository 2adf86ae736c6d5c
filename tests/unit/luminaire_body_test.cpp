// Bodies of luminaires: their shape, and where recessed ones stand.
#include "catch.hpp"
#include "property/transport_support.hpp"
#include "scene/luminaire_body.hpp"

using namespace dim;
using namespace dim::test;

namespace {

Luminaire lamp(const LuminousOpening& opening, const Vec3& at = {0, 0, 0}, const Vec3& aim = {0.3, -0.2, -1}) {
  Lights lights;
  return add_lamp(lights, "lamp", at, IntensityTable::lambertian(1.0),
                  {.aim = aim, .opening = opening, .body = true});
}

struct Shape {
  double area_m2 = 0.0, volume_m3 = 0.0;
  Vec3 area_vector{0.0};
  double nearest_m = 1e9, farthest_m = -1e9;  // behind the opening's plane
};

// Volume by the divergence theorem.
Shape shape_of(const Luminaire& luminaire, const Vec3& facing) {
  Shape shape;
  for (const auto& surface : body_surfaces(luminaire)) {
    const Polygon& polygon = surface.polygon;
    shape.area_m2 += polygon.area_m2();
    shape.area_vector += polygon.area_m2() * polygon.normal();
    shape.volume_m3 += polygon.area_m2() * glm::dot(polygon.centroid(), polygon.normal()) / 3.0;
    for (const auto& ring : polygon.corners()) {
      for (const auto& p : ring) {
        const double behind_m = -glm::dot(p - luminaire.at, facing);
        shape.nearest_m = std::min(shape.nearest_m, behind_m);
        shape.farthest_m = std::max(shape.farthest_m, behind_m);
      }
    }
  }
  return shape;
}

}  // namespace

TEST_CASE("A flat opening has a two-sided panel just behind it", "[bodies][unit]") {
  const auto [opening, area_m2] = GENERATE(
      std::pair(rectangle(0.6, 0.3), 0.18),
      std::pair(LuminousOpening{OpeningShape::kEllipse, 0.4, 0.2, 0.0}, kPi / 4 * 0.08),
      std::pair(LuminousOpening{OpeningShape::kVerticalEllipse, 0.0, 0.4, 0.2}, kPi / 4 * 0.08));
  const Luminaire luminaire = lamp(opening, {1, 2, 3});
  const Vec3 facing = opening.shape == OpeningShape::kVerticalEllipse ? luminaire.c0 : luminaire.aim;
  const auto surfaces = body_surfaces(luminaire);
  REQUIRE(surfaces.size() == 2);
  CHECK(surfaces[0].name == "luminaire 'lamp' front");
  CHECK(surfaces[1].name == "luminaire 'lamp' back");
  CHECK(surfaces[0].twin == 1);
  CHECK(surfaces[1].twin == 0);
  CHECK_FALSE(surfaces[0].bounding);
  CHECK(glm::length(surfaces[0].polygon.normal() - facing) < 1e-12);
  CHECK(glm::length(surfaces[1].polygon.normal() + facing) < 1e-12);
  CHECK(surfaces[0].polygon.area_m2() == Approx(area_m2).epsilon(1e-12));
  CHECK(glm::length(surfaces[0].polygon.centroid() - (luminaire.at - 1e-4 * facing)) < 1e-12);
  const auto shape = shape_of(luminaire, facing);
  CHECK(shape.nearest_m == Approx(1e-4).epsilon(1e-9));
  CHECK(shape.farthest_m == Approx(1e-4).epsilon(1e-9));
}

TEST_CASE("An opening with a height has a closed body", "[bodies][unit]") {
  struct Case {
    LuminousOpening opening;
    double volume_m3, depth_m;
    std::size_t n_faces;
  };
  const auto test = GENERATE(
      Case{{OpeningShape::kBox, 1.2, 0.3, 0.15}, 1.2 * 0.3 * 0.15, 0.15, 6},
      Case{{OpeningShape::kVerticalCylinder, 0.4, 0.2, 0.3}, kPi / 4 * 0.08 * 0.3, 0.3, kRoundCorners + 2},
      Case{{OpeningShape::kEllipsoid, 0.4, 0.4, 0.4}, kPi / 4 * 0.16 * 0.2, 0.2, kRoundCorners + 2},
      Case{{OpeningShape::kHorizontalCylinder, 1.2, 0.1, 0.1}, 1.2 * 0.1 * 0.05, 0.05, 6});
  const Luminaire luminaire = lamp(test.opening, {0.4, -0.3, 0.2});
  const auto shape = shape_of(luminaire, luminaire.aim);
  CHECK(body_surfaces(luminaire).size() == test.n_faces);
  CHECK(shape.volume_m3 == Approx(test.volume_m3).epsilon(1e-9));
  CHECK(glm::length(shape.area_vector) < 1e-12);
  CHECK(shape.nearest_m == Approx(1e-4).epsilon(1e-9));
  CHECK(shape.farthest_m == Approx(1e-4 + test.depth_m).epsilon(1e-9));
}

TEST_CASE("There is no body without an area or without being asked for", "[bodies][unit]") {
  CHECK(body_surfaces(lamp({})).empty());
  CHECK(body_surfaces(lamp({OpeningShape::kLine, 1.2, 0.0, 0.0})).empty());
  Luminaire bare = lamp(rectangle(1, 1));
  bare.body = false;
  CHECK(body_surfaces(bare).empty());
}

TEST_CASE("A recessed luminaire's body lies between opening and ceiling", "[bodies][unit]") {
  const Zone zone = box_zone({4, 4, 2}, 0.5, 0.5);
  const double gap_m = GENERATE(0.0, 1e-6, 1e-4, 1.9e-4);
  Luminaire luminaire = lamp(rectangle(0.6, 0.6), {0.5, 0.5, 1.0 - gap_m}, {0, 0, -1});
  luminaire.at = clear_of_surfaces(luminaire, zone);
  CHECK(luminaire.at.x == 0.5);
  CHECK(luminaire.at.z == Approx(1.0 - 2e-4).epsilon(1e-12));
  for (const auto& surface : body_surfaces(luminaire)) CHECK(surface.polygon.centroid().z < 1.0 - 0.9e-4);
}

TEST_CASE("Luminaires that need no room keep their place", "[bodies][unit]") {
  const Zone zone = box_zone({4, 4, 2}, 0.5, 0.5);
  const auto keeps = [&](const Luminaire& luminaire) {
    return clear_of_surfaces(luminaire, zone) == luminaire.at;
  };
  CHECK(keeps(lamp(rectangle(0.6, 0.6), {0.5, 0.5, 1.0 - 3e-4}, {0, 0, -1})));
  CHECK(keeps(lamp(rectangle(0.6, 0.6), {0.5, 0.5, 1.0}, {0, 0, 1})));     // looks into the ceiling
  CHECK(keeps(lamp(rectangle(0.6, 0.6), {0.5, 0.5, 1.0}, {0, 1, -1})));    // aslant
  CHECK(keeps(lamp(rectangle(0.6, 0.6), {3.0, 0.5, 1.0}, {0, 0, -1})));    // beyond the ceiling's edge
  CHECK(keeps(lamp({}, {0.5, 0.5, 1.0}, {0, 0, -1})));
}
