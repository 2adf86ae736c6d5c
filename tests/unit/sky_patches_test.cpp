#include "sky/sky_patches.hpp"

#include "base/error.hpp"
#include "base/low_discrepancy.hpp"
#include "catch.hpp"
#include "sky/direction.hpp"

using namespace dim;

TEST_CASE("Patches fill the hemisphere, and their sines pi", "[sky][unit]") {
  const auto [subdivision, n] = GENERATE(std::pair{1, 145}, std::pair{2, 577}, std::pair{4, 2305});
  const SkyPatches patches(subdivision);
  REQUIRE(patches.size() == static_cast<std::size_t>(n));
  double solid = 0.0, horizontal = 0.0, cylinder = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    solid += patches.solid_angle_sr(p);
    horizontal += patches.horizontal_sr(p);
    cylinder += patches.cylinder_sr(p);
  }
  CHECK(solid == Approx(2.0 * kPi).epsilon(1e-13));
  CHECK(horizontal == Approx(kPi).epsilon(1e-13));
  CHECK(cylinder == Approx(0.5 * kPi * kPi).epsilon(1e-13));
  CHECK(patches.solid_angle_sr(patches.ground()) == 2.0 * kPi);
}

TEST_CASE("Tregenza's patches are numbered from the east anticlockwise, band by band", "[sky][unit]") {
  const SkyPatches patches;
  const auto middle = [&](std::size_t p) {
    const Vec3 c = patches.centre(p);
    return std::pair{degrees(altitude_rad(c)), degrees(azimuth_rad(c))};
  };
  const std::size_t first[] = {0, 30, 60, 84, 108, 126, 138, 144};
  for (std::size_t band = 0; band < 8; ++band)
    CHECK(middle(first[band]).first == Approx(band < 7 ? 6.0 + 12.0 * static_cast<double>(band) : 90.0));
  CHECK(middle(0).second == Approx(90.0));
  CHECK(middle(1).second == Approx(78.0));
  CHECK(middle(15).second == Approx(270.0));
  CHECK(patches.centre(66).y > 0.0);
  CHECK(patches.centre(66).x == Approx(0.0).margin(1e-12));
  CHECK(middle(61).second == Approx(75.0));
}

TEST_CASE("A direction drawn in a patch lies in it", "[sky][unit]") {
  const SkyPatches patches(GENERATE(1, 2, 4));
  const LowDiscrepancy4 points(7);
  for (std::size_t p = 0; p <= patches.ground(); ++p) {
    REQUIRE(patches.patch_of(patches.centre(p)) == p);
    for (std::uint64_t i = 0; i < 8; ++i) {
      const auto u = points(8 * p + i);
      REQUIRE(patches.patch_of(patches.direction(p, u[0], u[1])) == p);
    }
  }
}

TEST_CASE("Directions drawn in a patch fill it evenly", "[sky][unit]") {
  const SkyPatches patches;
  for (const std::size_t p : {std::size_t{0}, std::size_t{100}, std::size_t{143}}) {
    Vec3 sum(0.0);
    for (int k = 0; k < 64 * 64; ++k)
      sum += patches.direction(p, (k / 64 + 0.5) / 64.0, (k % 64 + 0.5) / 64.0) / 4096.0;
    const double share = patches.solid_angle_sr(p);
    CHECK(sum.z * share == Approx(patches.horizontal_sr(p)).epsilon(1e-9));
    // Across, a patch is as wide as the sine of its half width.
    const SkyBox& box = patches.box(p);
    const double half = 0.5 * (box.last_rad - box.first_rad);
    CHECK(std::hypot(sum.x, sum.y) * share ==
          Approx(patches.cylinder_sr(p) * std::sin(half) / half).epsilon(1e-3));
  }
}

TEST_CASE("A sky subdivided by three is refused", "[sky][unit]") {
  CHECK_THROWS_AS(SkyPatches(3), InternalError);
}

TEST_CASE("A zone turned to the east sees the north on its left", "[sky][unit]") {
  // +y points east: north is along -x.
  const Vec3 north = to_zone({0, 1, 0}, radians(90.0));
  CHECK(north.x == Approx(-1.0));
  CHECK(north.y == Approx(0.0).margin(1e-15));
  CHECK(glm::length(to_sky(north, radians(90.0)) - Vec3(0, 1, 0)) < 1e-15);
}

TEST_CASE("Ramps rise over their band, and their sums are exact", "[sky][unit]") {
  const SkyPatches patches(GENERATE(1, 2));
  REQUIRE(patches.n_columns() == patches.size() + 1 + patches.n_ramps());
  for (std::size_t band = 0; band < patches.n_ramps(); ++band) {
    const std::size_t p = patches.first_of_band(band);
    CHECK(patches.band_of(p) == band);
    CHECK(patches.ramp_cd_m2(band, std::sin(patches.box(p).low_rad)) == Approx(0.0).margin(1e-12));
    CHECK(patches.ramp_cd_m2(band, std::sin(patches.box(p).high_rad)) == Approx(1.0));
    constexpr int kSteps = 2000;
    double horizontal = 0.0, cylinder = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double z = patches.direction(p, (k + 0.5) / kSteps, 0.5).z;
      const double ramp = (patches.ramp_cd_m2(band, z) - 0.5) * patches.solid_angle_sr(p) / kSteps;
      horizontal += ramp * z;
      cylinder += ramp * std::sqrt(1.0 - z * z);
    }
    CHECK(patches.ramp_horizontal_sr(band) == Approx(horizontal).epsilon(1e-5));
    CHECK(patches.ramp_cylinder_sr(band) == Approx(cylinder).epsilon(1e-5));
  }
  CHECK(patches.band_of(patches.size() - 1) == patches.n_ramps());
}
