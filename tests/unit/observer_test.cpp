// Tables against the published 1 nm ones, and what 5 nm costs.
#include "spectrum/observer.hpp"

#include "catch.hpp"
#include "reference_csv.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/rendering.hpp"

using namespace dim;
using namespace dim::test;

namespace {

void check_table(const std::string& file, const std::string& column, const SpectralCurve& curve) {
  const auto table = read_reference(shared_data() / "colorimetry" / file);
  if (table.rows.empty()) {
    WARN("skipped: " << file << " is not there");
    return;
  }
  CAPTURE(file, column);
  for (const auto& [nm, value] : table.points(column)) {
    if (nm < 380 || nm > 780 || std::fmod(nm, 5.0) != 0.0) continue;
    REQUIRE(curve.at(nm) == Approx(value).margin(1e-9));
  }
}

// Sums every `step_nm` of a spectrum that is itself known at any wavelength.
Vec3 summed(const Observer& eye, const SpectralCurve& spd, double step_nm) {
  Vec3 sum(0.0);
  for (double nm = 380; nm <= 780; nm += step_nm)
    sum += step_nm * spd.at(nm) * Vec3(eye.x.at(nm), eye.y.at(nm), eye.z.at(nm));
  return sum;
}

}  // namespace

TEST_CASE("Every table holds the published values", "[spectrum][unit]") {
  const std::string two = "cie_1931_2deg_xyz_1nm.csv", ten = "cie_1964_10deg_xyz_1nm.csv";
  check_table(two, "xbar", cie_1931_observer().x);
  check_table(two, "ybar", cie_1931_observer().y);
  check_table(two, "zbar", cie_1931_observer().z);
  check_table(ten, "xbar", cie_1964_observer().x);
  check_table(ten, "ybar", cie_1964_observer().y);
  check_table(ten, "zbar", cie_1964_observer().z);
  check_table("cie_photopic_v_1nm.csv", "V", photopic_efficiency());
  check_table("cie_scotopic_vprime_1nm.csv", "Vprime", scotopic_efficiency());
  check_table("cie_s026_alpha_opic_1nm.csv", "melanopic", melanopic_action());
}

TEST_CASE("Steps of 5 nm move the colour of smooth light by less than 3e-5, of LEDs by 1.5e-4",
          "[spectrum][unit]") {
  const auto table = read_reference(shared_data() / "colorimetry/cie_1931_2deg_xyz_1nm.csv");
  if (table.rows.empty()) {
    WARN("skipped: cie_1931_2deg_xyz_1nm.csv is not there");
    return;
  }
  const Observer fine{SpectralCurve(table.points("xbar")), SpectralCurve(table.points("ybar")),
                      SpectralCurve(table.points("zbar"))};
  const auto lights = read_reference(shared_data() / "illuminants/cie_a_d65_1nm.csv");
  const auto leds = read_reference(shared_data() / "illuminants/white_led_measured_1nm.csv");
  for (const auto& spd :
       {SpectralCurve(1.0), SpectralCurve(lights.points("A")), SpectralCurve(lights.points("D65"))}) {
    const Vec3 coarse = summed(cie_1931_observer(), spd, 5.0), exact = summed(fine, spd, 1.0);
    CHECK(xy_of(coarse).x == Approx(xy_of(exact).x).margin(3e-5));
    CHECK(xy_of(coarse).y == Approx(xy_of(exact).y).margin(3e-5));
    CHECK(coarse.y == Approx(exact.y).epsilon(3e-5));
  }
  // Measured LEDs known every 1 nm, of which the programs take means over 5 nm.
  for (std::size_t c = 1; c < leds.columns.size(); ++c) {
    const SpectralCurve spd(leds.points(leds.columns[c]));
    const Vec3 ours = light_responses(spd).xyz, exact = summed(fine, spd, 1.0);
    CHECK(xy_of(ours).x == Approx(xy_of(exact).x).margin(1.5e-4));
    CHECK(xy_of(ours).y == Approx(xy_of(exact).y).margin(1.5e-4));
    CHECK(ours.y == Approx(exact.y).epsilon(5e-4));
  }
}
