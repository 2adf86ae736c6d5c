#include <cmath>

#include "catch.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"

namespace {

dim::Photometry read(const std::string& name) {
  dim::Warnings warnings;
  return dim::read_photometric_file(std::string(DIM_SOURCE_DIR) + "/tests/data/photometry/" + name, warnings);
}

/// Direction of H and V in degrees, by the definitions of the two types.
dim::Vec3 direction_b(double h_deg, double v_deg) {
  const double h = dim::radians(h_deg), v = dim::radians(v_deg);
  return {std::sin(h), std::cos(h) * std::sin(v), std::cos(h) * std::cos(v)};
}

dim::Vec3 direction_a(double h_deg, double v_deg) {
  const double h = dim::radians(h_deg), v = dim::radians(v_deg);
  return {std::cos(v) * std::sin(h), std::sin(v), std::cos(v) * std::cos(h)};
}

}  // namespace

TEST_CASE("Types A and B of 100 cd over the hemisphere emit 200 pi lm", "[photometry][unit]") {
  for (const char* name : {"type_a.ies", "type_b.ies"}) {
    const auto p = read(name);
    CHECK(p.flux_lm == Approx(200 * dim::kPi).epsilon(1e-12));
    CHECK(p.symmetry == dim::Symmetry::kLateral);
    const dim::IntensityTable table(p.distribution);
    CHECK(table.zero_behind());
    CHECK_FALSE(table.axial());
    CHECK(table.at({0.3, -0.4, 0.1}) == Approx(100));
    CHECK(table.at({0.3, -0.4, -0.1}) == 0.0);
  }
  CHECK(read("type_b_upper_only.ies").flux_lm == Approx(100 * dim::kPi).epsilon(1e-12));
}

TEST_CASE("Type B turns by V about C0-C180 and leans by H towards C0", "[photometry][unit]") {
  // Rows of H -90, 0, 90; in each V -90, 0, 90.
  const auto p = read("type_b_whole.ies");
  const dim::IntensityTable table(p.distribution);
  CHECK(table.at({0, 0, 1}) == Approx(50));
  CHECK(table.at(direction_b(0, 89.9999)) == Approx(60).epsilon(1e-5));
  CHECK(table.at(direction_b(0, -89.9999)) == Approx(40).epsilon(1e-5));
  CHECK(table.at(direction_b(45, 45)) == Approx((50 + 60 + 80 + 90) / 4.0));
  CHECK(table.at(direction_b(-30, 30)) == Approx((2 * (2 * 50.0 + 60) / 3 + (2 * 20.0 + 30) / 3) / 3));
  CHECK(table.at_c_gamma(dim::radians(0), dim::radians(45)) == Approx(65));    // towards C0: H = 45
  CHECK(table.at_c_gamma(dim::radians(90), dim::radians(45)) == Approx(55));   // towards C90: V = 45
  CHECK(table.at_c_gamma(dim::radians(270), dim::radians(45)) == Approx(45));  // V = -45
  // Width is across the plane H = 0, which holds C90.
  CHECK(p.opening.length_m == Approx(0.6));
  CHECK(p.opening.width_m == Approx(0.4));
}

TEST_CASE("Type A turns by H about C90-C270 and leans by V towards C90", "[photometry][unit]") {
  const dim::IntensityTable table(read("type_a_whole.ies").distribution);
  CHECK(table.at({0, 0, 1}) == Approx(50));
  CHECK(table.at(direction_a(45, 45)) == Approx((50 + 60 + 80 + 90) / 4.0));
  CHECK(table.at(direction_a(-30, 60)) == Approx((2 * (50.0 + 2 * 60) / 3 + (20.0 + 2 * 30) / 3) / 3));
  CHECK(table.at_c_gamma(0, dim::radians(45)) == Approx(65));
  CHECK(table.at_c_gamma(dim::radians(90), dim::radians(45)) == Approx(55));
}

TEST_CASE("The flux of types A and B is the sum over solid angles", "[photometry][unit]") {
  for (const char* name : {"type_b_whole.ies", "type_a_whole.ies"}) {
    const auto p = read(name);
    const dim::IntensityTable table(p.distribution);
    const int n = 400;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 2 * n; ++j) {
        const double z = 1.0 - (i + 0.5) / n;
        const double c = (j + 0.5) * dim::kPi / n;
        const double s = std::sqrt(1.0 - z * z);
        sum += table.at({s * std::cos(c), s * std::sin(c), z});
      }
    CHECK(sum * dim::kPi / (n * n) == Approx(p.flux_lm).epsilon(1e-4));
  }
}

TEST_CASE("Types A and B with impossible angles are refused", "[photometry][unit]") {
  const auto refused = [](const char* name, const char* says) {
    try {
      read(name);
      FAIL_CHECK(name << " was read");
    } catch (const dim::InputError& error) {
      CHECK_THAT(error.problems().front().what, Catch::Matchers::Contains(says));
    }
  };
  refused("bad_type_b_one_plane.ies", "1 horizontal angle is too few for photometric type B");
  refused("bad_type_b_h_45.ies", "horizontal angles run from 45 to 90");
  refused("bad_type_b_v_200.ies", "vertical angle 3 of 3: 200 is outside -180..180");
}

TEST_CASE("Type B becomes EULUMDAT by resampling, its flux kept to 0.1 %", "[photometry][unit]") {
  dim::Warnings warnings;
  const auto p = read("type_b_whole.ies");
  const auto q = dim::read_photometry(dim::eulumdat_text(p, warnings), "x.ldt", warnings);
  CHECK(warnings.size() == 1);
  CHECK(q.flux_lm == Approx(p.flux_lm).epsilon(1e-3));
}

TEST_CASE("Lamp tilt: linear between angles, reflected beyond 90 degrees", "[photometry][unit]") {
  const dim::LampTilt half = {1, {0, dim::radians(30), dim::radians(90)}, {1.0, 0.97, 0.91}};
  CHECK(dim::tilt_factor(half, 0) == 1.0);
  CHECK(dim::tilt_factor(half, dim::radians(15)) == Approx(0.985));
  CHECK(dim::tilt_factor(half, dim::radians(60)) == Approx(0.94));
  CHECK(dim::tilt_factor(half, dim::radians(120)) == Approx(0.94));
  CHECK(dim::tilt_factor(half, dim::radians(180)) == 1.0);
  const dim::LampTilt whole = {1, {0, dim::radians(180)}, {1.0, 0.8}};
  CHECK(dim::tilt_factor(whole, dim::radians(135)) == Approx(0.85));
}

TEST_CASE("Japanese keywords come out as UTF-8, brackets inside a character or not", "[photometry][unit]") {
  const auto p = read("shift_jis_keyword.ies");
  CHECK(p.keyword("LUMINAIRE") == "照明器具 ソ表示");
  CHECK(p.keyword("ソ表示") == "値は十分");
}
