// Diffuse light in a deep shaft of mirrors, all the way through the programs' own solution.
#include <cmath>

#include "catch.hpp"
#include "property/shine_rooms.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr double kWidth_m = 0.5, kDepth_m = 3.0;

// Share of what an evenly lit floor sends up that arrives, by the unfolded lattice of a shaft of mirrors of
// reflectance f; what has met more than `most` of them left out.
double share_that_arrives(double f, int most) {
  constexpr int kTheta = 300, kPhi = 36, kStart = 6;
  double share = 0.0;
  for (int s = 0; s < kStart * kStart; ++s) {
    const double x0 = kWidth_m * ((s % kStart + 0.5) / kStart - 0.5);
    const double y0 = kWidth_m * ((s / kStart + 0.5) / kStart - 0.5);
    for (int i = 0; i < kTheta; ++i) {
      const double cos2 = (i + 0.5) / kTheta, along_m = kDepth_m * std::sqrt((1.0 - cos2) / cos2);
      for (int j = 0; j < kPhi; ++j) {
        const double phi = 2 * kPi * (j + 0.37) / kPhi;
        const int met = int(std::abs(std::round((x0 + along_m * std::cos(phi)) / kWidth_m)) +
                            std::abs(std::round((y0 + along_m * std::sin(phi)) / kWidth_m)));
        if (met <= most) share += std::pow(f, met) / (kTheta * kPhi * kStart * kStart);
      }
    }
  }
  return share;
}

double mean_lx(const Zone& zone, int face, const std::vector<double>& lx) {
  const Cells cells(zone);
  double sum = 0.0, area_m2 = 0.0;
  for (std::size_t i = cells.first(std::size_t(face)); i < cells.first(std::size_t(face) + 1); ++i) {
    sum += cells.area_m2(i) * lx[i];
    area_m2 += cells.area_m2(i);
  }
  return sum / area_m2;
}

}  // namespace

TEST_CASE("What a floor sends up a shaft of mirrors arrives at its top", "[mirror][validation]") {
  // Where following sixteen mirrors, or a tenth of the light, would not do.
  const auto [f, too_few] = GENERATE(std::pair(0.95, 16), std::pair(0.7, 6));
  const double rho = 0.6;
  Zone zone = shiny_room(rho, 0.1, {kWidth_m, kWidth_m, kDepth_m});
  for (const int face : {kY0, kY1, kX0, kX1}) make_mirror_of(zone, face, f);
  // Close above the floor, looking down: nothing of its own reaches the top.
  Lights lights;
  add_lamp(lights, "low", {0.03, -0.05, -kDepth_m / 2 + 0.4}, IntensityTable::lambertian(100.0));
  const auto solution = solve(zone, lights, network_of(zone, {32, 64}));
  const auto lx = cell_lx(solution);
  const double arrives = share_that_arrives(f, 1'000'000);
  REQUIRE(share_that_arrives(f, too_few) < 0.97 * arrives);
  CHECK(mean_lx(zone, kCeiling, lx) / (rho * mean_lx(zone, kFloor, lx)) == Approx(arrives).epsilon(0.01));
}
