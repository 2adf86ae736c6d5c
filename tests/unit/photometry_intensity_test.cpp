#include <cmath>
#include <random>

#include "base/error.hpp"
#include "catch.hpp"
#include "photometry/intensity.hpp"

namespace {

using dim::kPi;
using dim::Vec3;

Vec3 direction(double c, double gamma) {
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)};
}

dim::IntensityDistribution axial(std::vector<double> gamma_deg, const std::vector<double>& cd) {
  dim::IntensityDistribution d;
  d.c_rad = {0.0, 2 * kPi};
  for (const double g : gamma_deg) d.gamma_rad.push_back(dim::radians(g));
  d.intensity_cd = cd;
  d.intensity_cd.insert(d.intensity_cd.end(), cd.begin(), cd.end());
  return d;
}

}  // namespace

TEST_CASE("The angle of a vector agrees with atan2 to 1e-15", "[photometry][unit]") {
  double worst = 0.0;
  for (int i = -2000; i <= 2000; ++i) {
    const double a = kPi * i / 2000.0;
    const double y = std::sin(a) * 3.7;
    const double x = std::cos(a) * 3.7;
    const double whole = std::atan2(y, x) < 0.0 ? std::atan2(y, x) + 2 * kPi : std::atan2(y, x);
    worst = std::max(worst, std::abs(dim::whole_turn_angle(y, x) - whole));
    worst = std::max(worst, std::abs(dim::half_turn_angle(std::abs(y), x) - std::atan2(std::abs(y), x)));
  }
  CHECK(worst < 1e-15);
  CHECK(dim::half_turn_angle(0.0, 0.0) == 0.0);
  CHECK(dim::half_turn_angle(0.0, -1.0) == kPi);
  CHECK(dim::half_turn_angle(1e-12, 1.0) == Approx(1e-12).epsilon(1e-12));
}

TEST_CASE("An angle is found in even, uneven and crowded grids alike", "[photometry][unit]") {
  std::mt19937_64 random(11);
  std::vector<std::vector<double>> grids = {{0.0, 0.5, 1.0, 1.5}, {0.0, 0.1, 1.0, 1.01, 3.0}, {0.0, 3.0}};
  std::vector<double> crowded = {0.0};
  for (int i = 0; i < 300; ++i) crowded.push_back(1.0 + i * 1e-9);
  crowded.push_back(3.0);
  grids.push_back(crowded);
  for (const auto& nodes : grids) {
    const dim::AngleGrid grid(nodes);
    std::uniform_real_distribution<double> angle(nodes.front(), nodes.back());
    std::vector<double> angles = nodes;
    for (int i = 0; i < 500; ++i) angles.push_back(angle(random));
    for (const double a : angles) {
      const auto spot = grid.locate(a);
      REQUIRE(spot.index + 1 < nodes.size());
      REQUIRE(nodes[spot.index] <= a);
      REQUIRE(a <= nodes[spot.index + 1]);
      REQUIRE(nodes[spot.index] + spot.fraction * (nodes[spot.index + 1] - nodes[spot.index]) ==
              Approx(a).margin(1e-12));
    }
  }
}

TEST_CASE("Isotropic and Lambertian sources are exact", "[photometry][unit]") {
  const auto isotropic = dim::IntensityTable::isotropic(100.0);
  CHECK(isotropic.flux_lm() == Approx(400.0 * kPi).epsilon(1e-15));
  CHECK(isotropic.at({0.3, -0.2, -5.0}) == 100.0);
  CHECK_FALSE(isotropic.zero_behind());
  const auto lambertian = dim::IntensityTable::lambertian(100.0);
  CHECK(lambertian.flux_lm() == Approx(100.0 * kPi).epsilon(1e-15));
  CHECK(lambertian.at(direction(1.0, dim::radians(60))) == Approx(50.0).epsilon(1e-14));
  CHECK(lambertian.at(7.0 * direction(1.0, dim::radians(60))) == Approx(50.0).epsilon(1e-14));
  CHECK(lambertian.at({1.0, 0.0, 0.0}) == 0.0);
  CHECK(lambertian.at({0.0, 0.0, -1.0}) == 0.0);
  CHECK(lambertian.zero_behind());
  CHECK(lambertian.at_c_gamma(1.0, dim::radians(60)) == Approx(50.0));
}

TEST_CASE("A table is linear between its angles and zero outside them", "[photometry][unit]") {
  const dim::IntensityTable table(axial({10, 30, 90}, {100, 200, 50}));
  CHECK(table.axial());
  CHECK(table.at(direction(0.7, dim::radians(20))) == Approx(150.0));
  CHECK(table.at(direction(4.0, dim::radians(60))) == Approx(125.0));
  CHECK(table.at(direction(0.0, dim::radians(9.99))) == 0.0);
  CHECK(table.at({1.0, 0.0, 0.0}) == Approx(50.0));
  CHECK(table.at({1.0, 0.0, -1e-9}) == 0.0);
  CHECK(table.zero_behind());
  CHECK(table.max_cd() == 200.0);
}

TEST_CASE("A table is linear between its planes, C90 being +y", "[photometry][unit]") {
  dim::IntensityDistribution d;
  d.c_rad = {0.0, dim::radians(90), dim::radians(180), dim::radians(270), 2 * kPi};
  d.gamma_rad = {0.0, kPi};
  for (const double cd : {100.0, 200.0, 400.0, 300.0, 100.0})
    d.intensity_cd.insert(d.intensity_cd.end(), 2, cd);
  const dim::IntensityTable table(d);
  CHECK_FALSE(table.axial());
  CHECK(table.at({1, 0, 0}) == Approx(100.0));
  CHECK(table.at({0, 1, 0}) == Approx(200.0));
  CHECK(table.at({-1, 0, 0}) == Approx(400.0));
  CHECK(table.at({0, -1, 0}) == Approx(300.0));
  CHECK(table.at({1, 1, 0.3}) == Approx(150.0));
  CHECK(table.at({1, -1, -0.3}) == Approx(200.0));
  CHECK(table.at_c_gamma(dim::radians(45), 1.0) == Approx(150.0));
  CHECK(table.flux_lm() == Approx(4 * kPi * 250.0).epsilon(1e-14));
  CHECK_FALSE(table.zero_behind());
}

TEST_CASE("Flux is the closed-form integral of the interpolant", "[photometry][unit]") {
  // I = gamma over 0..pi: 2 pi int g sin g dg = 2 pi^2.
  const dim::IntensityTable ramp(axial({0, 37, 180}, {0.0, dim::radians(37), kPi}));
  CHECK(ramp.flux_lm() == Approx(2 * kPi * kPi).epsilon(1e-14));
  // Very narrow intervals do not cancel: the same ramp cut into 20,000.
  std::vector<double> gamma;
  std::vector<double> cd;
  for (int i = 0; i <= 20000; ++i) {
    gamma.push_back(180.0 * i / 20000);
    cd.push_back(dim::radians(gamma.back()));
  }
  CHECK(dim::IntensityTable(axial(gamma, cd)).flux_lm() == Approx(2 * kPi * kPi).epsilon(1e-13));
  CHECK(dim::IntensityTable(axial({0, 90}, {100, 100})).flux_lm() == Approx(200 * kPi).epsilon(1e-14));
}

TEST_CASE("Light that reaches past 90 degrees between two angles is not zero behind", "[photometry][unit]") {
  CHECK_FALSE(dim::IntensityTable(axial({0, 85, 95}, {9, 9, 0})).zero_behind());
  CHECK(dim::IntensityTable(axial({0, 85, 90, 95}, {9, 9, 0, 0})).zero_behind());
  CHECK(dim::IntensityTable(axial({0, 180}, {0, 0})).zero_behind());
}

TEST_CASE("A distribution that does not fit its own description is refused", "[photometry][unit]") {
  auto d = axial({0, 90}, {1, 1});
  d.intensity_cd.pop_back();
  CHECK_THROWS_AS(dim::IntensityTable(d), dim::InternalError);
  CHECK_THROWS_AS(dim::IntensityTable(axial({0, 90}, {1, -1})), dim::InternalError);
  CHECK_THROWS_AS(dim::IntensityTable(axial({90, 0}, {1, 1})), dim::InternalError);
  CHECK_THROWS_AS(dim::IntensityTable(axial({0, 200}, {1, 1})), dim::InternalError);
}
