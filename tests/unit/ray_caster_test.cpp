#include "geometry/ray_caster.hpp"

#include <tbb/global_control.h>

#include <random>

#include "catch.hpp"

using namespace dim;

namespace {

/// Inward-facing faces of a box.
std::vector<Polygon> box_m(const Vec3& lo, const Vec3& hi) {
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  return {Polygon({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}),
          Polygon({at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}),
          Polygon({at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}),
          Polygon({at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}),
          Polygon({at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}),
          Polygon({at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)})};
}

std::vector<Plate> plates(const std::vector<Polygon>& polygons) {
  std::vector<Plate> result;
  for (const auto& polygon : polygons) result.push_back({&polygon});
  return result;
}

}  // namespace

TEST_CASE("No ray leaves a closed box, not even one aimed at an edge or a corner", "[geometry][property]") {
  for (const double scale : {1e-6, 1.0, 1e4}) {
    const auto polygons = box_m(Vec3(-3.7, -2.9, -1.4) * scale, Vec3(3.7, 2.9, 1.4) * scale);
    const RayCaster caster(plates(polygons), 10.0 * scale);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 from = Vec3(3.6 * unit(random), 2.8 * unit(random), 1.3 * unit(random)) * scale;
      Vec3 target = Vec3(3.7 * unit(random), 2.9 * unit(random), 1.4 * unit(random)) * scale;
      if (i % 4 < 3) target.x = 3.7 * scale;
      if (i % 4 < 2) target.y = -2.9 * scale;
      if (i % 4 < 1) target.z = 1.4 * scale;
      const Hit hit = caster.nearest(from, glm::normalize(target - from));
      REQUIRE(hit.plate >= 0);
      CHECK_FALSE(hit.back);
    }
  }
}

TEST_CASE("A hit's local point and distance are exact in double", "[geometry][unit]") {
  const auto polygons = box_m({-3, -2, -1}, {3, 2, 1});
  const RayCaster caster(plates(polygons), 8.0);
  const Vec3 from(0.1, 0.2, 0.3), direction = glm::normalize(Vec3(0.3, -0.2, -0.9));
  const Hit hit = caster.nearest(from, direction);
  REQUIRE(hit.plate == 0);
  CHECK(hit.t == Approx(1.3 / -direction.z).epsilon(1e-14));
  const auto& polygon = polygons[0];
  CHECK(glm::length(polygon.frame().to_world(hit.local) - (from + hit.t * direction)) < 1e-14);
}

TEST_CASE("Rays pass through a hole and are stopped by the rest", "[geometry][unit]") {
  const Polygon sheet({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
                      {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}});
  const RayCaster caster({{&sheet}}, 5.0);
  CHECK_FALSE(caster.blocked({1.5, 1.5, 1}, {1.5, 1.5, -1}));
  CHECK(caster.blocked({0.5, 1.5, 1}, {0.5, 1.5, -1}));
  CHECK_FALSE(caster.blocked({0.5, 1.5, 1}, {0.5, 1.5, 0.1}));
  CHECK_FALSE(caster.blocked({0.5, 1.5, 1}, {0.5, 1.5, -1}, 0));
}

TEST_CASE("A path that ends on a plate is not blocked by it", "[geometry][unit]") {
  const Polygon sheet({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  const RayCaster caster({{&sheet}}, 5.0);
  CHECK_FALSE(caster.blocked({1, 1, 1}, {1, 1, 0}));
  CHECK(caster.blocked({1, 1, 1}, {1, 1, -0.001}));
}

TEST_CASE("A plate with an open back lets rays from behind pass", "[geometry][unit]") {
  const Polygon sheet({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  CHECK(RayCaster({{&sheet, false}}, 5.0).nearest({1, 1, -1}, {0, 0, 1}).back);
  CHECK(RayCaster({{&sheet, true}}, 5.0).nearest({1, 1, -1}, {0, 0, 1}).plate == -1);
  CHECK(RayCaster({{&sheet, true}}, 5.0).nearest({1, 1, 1}, {0, 0, -1}).plate == 0);
}

TEST_CASE("A ray caster leaves the number of threads alone", "[geometry][unit]") {
  const auto allowed = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const auto before = allowed();
  const auto room = box_m({0, 0, 0}, {1, 1, 1});
  const RayCaster caster(plates(room), 2.0);
  CHECK(allowed() == before);
}
