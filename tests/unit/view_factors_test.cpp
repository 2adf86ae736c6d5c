#include "geometry/view_factors.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>

#include "catch.hpp"
#include "geometry/area_sampler.hpp"
#include "geometry/pair_exchange.hpp"
#include "geometry/spherical_triangle.hpp"

using namespace dim;

namespace {

std::vector<Plate> plates(const std::vector<Polygon>& polygons) {
  std::vector<Plate> result;
  for (const auto& polygon : polygons) result.push_back({&polygon});
  return result;
}

void add_box(std::vector<Polygon>& polygons, const Vec3& lo, const Vec3& hi, bool outward) {
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  const std::vector<Ring3> faces = {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                                    {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
                                    {at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
                                    {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
                                    {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)},
                                    {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}};
  for (auto ring : faces) {
    if (outward) std::reverse(ring.begin(), ring.end());
    polygons.emplace_back(ring);
  }
}

std::vector<Polygon> room_with_desk() {
  std::vector<Polygon> polygons;
  add_box(polygons, {-2, -1.5, -1.2}, {2, 1.5, 1.2}, false);
  add_box(polygons, {-1, -0.5, -0.5}, {0.4, 0.3, -0.45}, true);
  return polygons;
}

}  // namespace

TEST_CASE("Sampled points have the centroid of the region, holes left out", "[geometry][unit]") {
  const std::vector<Ring2> region = {{{0, 0}, {4, 0.5}, {3, 3}, {1, 2}, {0.5, 3}},
                                     {{1, 0.5}, {1, 1.5}, {2, 1.5}, {2, 0.5}}};
  const AreaSampler sampler(region);
  double area_m2 = 0.0;
  Vec2 exact(0.0);
  for (const auto& ring : region) {
    const auto moments = area_moments(ring);
    area_m2 += moments[0];
    exact += Vec2(moments[1], moments[2]);
  }
  CHECK(sampler.area() == Approx(area_m2).epsilon(1e-14));
  double of_triangles = 0.0;
  for (const auto& t : sampler.triangles()) of_triangles += signed_area({t[0], t[1], t[2]});
  CHECK(of_triangles == Approx(area_m2).epsilon(1e-14));
  Vec2 sum(0.0);
  constexpr int kSteps = 20000, kAcross = 20;
  int in_hole = 0;
  for (int i = 0; i < kSteps * kAcross; ++i) {
    const Vec2 p = sampler.point((i / kAcross + 0.5) / kSteps, (i % kAcross + 0.5) / kAcross);
    if (p.x > 1 && p.x < 2 && p.y > 0.5 && p.y < 1.5) ++in_hole;
    sum += p;
  }
  CHECK(in_hole == 0);
  CHECK(glm::length(sum / double(kSteps * kAcross) - exact / area_m2) < 2e-4);
}

TEST_CASE("An octant of the sphere is half pi, its sampled mean direction as by symmetry",
          "[geometry][unit]") {
  const SphericalTriangle octant({2, 0, 0}, {0, 0.1, 0}, {0, 0, 30});
  CHECK(octant.solid_angle_sr() == Approx(kPi / 2).epsilon(1e-14));
  Vec3 sum(0.0);
  constexpr int kSide = 200;
  for (int i = 0; i < kSide * kSide; ++i)
    sum += octant.direction((i / kSide + 0.5) / kSide, (i % kSide + 0.5) / kSide);
  // The integral of the direction over the octant is pi/4 along every axis.
  for (int axis = 0; axis < 3; ++axis) CHECK(sum[axis] / (kSide * kSide) == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("Exchange is the same whichever region is named first", "[geometry][unit]") {
  const std::vector<Ring3> floor = {{{0, 0, 0}, {3, 0, 0}, {2, 2, 0}}};
  const std::vector<Ring3> slope = {{{0, 0, 2}, {0.3, 2, 1.5}, {2.5, 1, 1.2}}};
  CHECK(pair_exchange_m2(floor, slope) == Approx(pair_exchange_m2(slope, floor)).epsilon(1e-8));
}

TEST_CASE("Exchange of small far regions goes with the inverse square", "[geometry][unit]") {
  for (const double a : {0.01, 0.001}) {
    const std::vector<Ring3> below = {{{0, 0, 0}, {a, 0, 0}, {a, a, 0}, {0, a, 0}}};
    const std::vector<Ring3> above = {{{0, 0, 1}, {0, a, 1}, {a, a, 1}, {a, 0, 1}}};
    // 1/(pi r^4) over both, with the mean square of the sideways distance a^2/3.
    const double exact = a * a * a * a / kPi * (1 - 2 * a * a / 3);
    CHECK(pair_exchange_m2(below, above) == Approx(exact).epsilon(1e-6));
  }
}

TEST_CASE("View factors do not depend on the number of threads", "[geometry][view_factors][unit]") {
  const auto polygons = room_with_desk();
  const auto all = view_factors(plates(polygons), 6.0, 1000);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = view_factors(plates(polygons), 6.0, 1000);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    REQUIRE(all.rows[i].size() == single.rows[i].size());
    for (std::size_t j = 0; j < polygons.size(); ++j) CHECK(all.at(i, j) == single.at(i, j));
  }
}

TEST_CASE("View factors of a furnished closed room are reciprocal and add up to one",
          "[geometry][view_factors][unit]") {
  const auto polygons = room_with_desk();
  const auto result = view_factors(plates(polygons), 6.0, 8192);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    CHECK(result.escaped[i] == 0.0);
    CHECK(result.behind[i] == 0.0);
    CHECK(result.row_sums[i] == Approx(1.0).margin(2e-3));
    CHECK(result.at(i, i) == 0.0);
    for (std::size_t j = 0; j < polygons.size(); ++j)
      CHECK(polygons[i].area_m2() * result.at(i, j) ==
            Approx(polygons[j].area_m2() * result.at(j, i)).epsilon(1e-14));
  }
  CHECK(result.reciprocity_total > 0.0);
  CHECK(result.reciprocity_total < 0.02);
  CHECK(result.reciprocity_rms <= result.reciprocity_total);
}

TEST_CASE("Rays out of an open room count as escaped, rays onto backs as such",
          "[geometry][view_factors][unit]") {
  const Polygon floor(Ring3{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Polygon above(Ring3{{-50, -50, 1}, {50, -50, 1}, {50, 50, 1}, {-50, 50, 1}});
  const auto closed = view_factors({{&floor}, {&above, false}}, 100.0, 4096);
  CHECK(closed.rows[0].empty());
  CHECK(closed.behind[0] > 0.99);
  const auto open = view_factors({{&floor}, {&above, true}}, 100.0, 4096);
  CHECK(open.escaped[0] == 1.0);
}

TEST_CASE("A stopped job interrupts the view factors", "[geometry][view_factors][unit]") {
  const auto polygons = room_with_desk();
  const std::atomic<bool> stop = true;
  Job job;
  job.stop = &stop;
  CHECK_THROWS_AS(view_factors(plates(polygons), 6.0, 1000, job), Interrupted);
}
