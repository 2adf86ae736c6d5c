#include "sky/sky_model.hpp"

#include <array>

#include "catch.hpp"
#include "reference_csv.hpp"
#include "sky/direction.hpp"

using namespace dim;

namespace {

/// Horizontal illuminance by another quadrature: midpoints on rings round the sun, closer near it, each cut
/// at the horizon.
double horizontal_lx(const Sky& sky, const Vec3& sun) {
  constexpr int kRings = 1500, kSpokes = 1500;
  const Vec3 u = perpendicular(sun), v = glm::cross(sun, u);
  double sum = 0.0;
  for (int j = 0; j < kSpokes; ++j) {
    const double psi = 2.0 * kPi * (j + 0.5) / kSpokes;
    const Vec3 across = std::cos(psi) * u + std::sin(psi) * v;
    const double end = std::min(kPi, std::atan2(across.z, sun.z) + 0.5 * kPi);
    for (int i = 0; i < kRings; ++i) {
      const double x = (i + 0.5) / kRings, chi = end * x * x;
      const Vec3 d = std::cos(chi) * sun + std::sin(chi) * across;
      // d(chi) = 2 end x dx
      if (d.z > 0.0) sum += sky.luminance_cd_m2(d) * d.z * std::sin(chi) * 2.0 * end * x;
    }
  }
  return sum * 2.0 * kPi / (static_cast<double>(kRings) * kSpokes);
}

}  // namespace

TEST_CASE("The traditional overcast sky gives 7 pi / 9 of its zenith luminance", "[sky][unit]") {
  const Sky sky(SkyModel::overcast(), {0, 0, 1}, 10000.0);
  CHECK(sky.luminance_cd_m2({0, 0, 1}) == Approx(10000.0 * 9.0 / (7.0 * kPi)).epsilon(1e-9));
  CHECK(sky.luminance_cd_m2({1, 0, 1e-12}) == Approx(10000.0 * 3.0 / (7.0 * kPi)).epsilon(1e-9));
  CHECK(sky.luminance_cd_m2({1, 0, -0.1}) == 0.0);
}

TEST_CASE("A uniform sky gives pi times its luminance", "[sky][unit]") {
  CHECK(Sky(SkyModel::uniform(), {0, 0, 1}, 1000.0).luminance_cd_m2({0.6, 0, 0.8}) ==
        Approx(1000.0 / kPi).epsilon(1e-12));
}

TEST_CASE("CIE and Perez skies are scaled to 1e-6 of the horizontal illuminance", "[sky][unit]") {
  for (const double altitude : {1.0, 60.0}) {
    const Vec3 sun = sky_direction(radians(altitude), radians(137.0));
    for (const int type : {7, 15}) {
      CAPTURE(altitude, type);
      CHECK(horizontal_lx(Sky(SkyModel::cie(type), sun, 1.0), sun) == Approx(1.0).epsilon(1e-6));
    }
    const auto perez = SkyModel::perez({6.0, 0.1}, radians(90.0 - altitude));
    CAPTURE(altitude);
    CHECK(horizontal_lx(Sky(perez, sun, 1.0), sun) == Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("Zenith, horizon and aureole of the CIE skies are those of the standard", "[sky][unit]") {
  const auto table = test::read_reference(test::shared_data() / "sky/cie_general_sky_derived.csv");
  if (table.rows.empty()) {
    WARN("skipped: no reference data sky/cie_general_sky_derived.csv");
    return;
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double altitude = radians(table.number(row, "sun_altitude_deg"));
    const Vec3 sun = sky_direction(altitude, 0.0);
    const Sky sky(SkyModel::cie(static_cast<int>(table.number(row, "type"))), sun, 1.0);
    const double zenith = sky.luminance_cd_m2({0, 0, 1});
    CAPTURE(row);
    CHECK(zenith == Approx(table.number(row, "zenith_luminance_over_diffuse_horizontal_illuminance_per_sr"))
                        .epsilon(2e-5));
    CHECK(sky.luminance_cd_m2(sun) / zenith == Approx(table.number(row, "at_sun_over_zenith")).epsilon(1e-5));
    // "Horizon" of the table is that of the gradation's limit.
    CHECK(sky.luminance_cd_m2(sky_direction(1e-9, 0.0)) / zenith ==
          Approx(table.number(row, "horizon_under_sun_over_zenith")).epsilon(1e-5));
  }
}

TEST_CASE("Coefficients of the Perez sky are those published", "[sky][unit]") {
  const auto table = test::read_reference(test::shared_data() / "sky/perez_1993_luminance.csv");
  if (table.rows.empty()) {
    WARN("skipped: no reference data sky/perez_1993_luminance.csv");
    return;
  }
  const double zenith = radians(50.0), delta = 0.3;
  const Vec3 sun = sky_direction(0.5 * kPi - zenith, 1.0), dark = sky_direction(0.4, 3.5);
  for (std::size_t row = 0; row < 8; ++row) {
    const auto law = [&](const std::string& x) {
      const auto k = [&](int i) { return table.number(row, x + std::to_string(i)); };
      if (row == 0 && x == "c") return std::exp(std::pow(delta * (k(1) + k(2) * zenith), k(3))) - k(4);
      if (row == 0 && x == "d") return -std::exp(delta * (k(1) + k(2) * zenith)) + k(3) + delta * k(4);
      return k(1) + k(2) * zenith + delta * (k(3) + k(4) * zenith);
    };
    const auto expected = [&](const Vec3& d) {
      const double chi = std::acos(std::min(1.0, glm::dot(d, sun)));
      return (1.0 + law("a") * std::exp(law("b") / d.z)) *
             (1.0 + law("c") * std::exp(law("d") * chi) + law("e") * std::pow(std::cos(chi), 2));
    };
    const auto sky = SkyModel::perez({table.number(row, "epsilon_low") + 0.001, delta}, zenith);
    CAPTURE(row);
    CHECK(sky(sun, sun) == Approx(expected(sun)).epsilon(1e-6));
    CHECK(sky(dark, sun) == Approx(expected(dark)).epsilon(1e-9));
    CHECK(sky({0, 0, 1}, sun) == Approx(expected({0, 0, 1})).epsilon(1e-9));
  }
}
