#include "catch.hpp"
#include "photometry/photometry_file.hpp"

namespace {

using dim::kPi;
using dim::Symmetry;

std::string corpus(const std::string& name) {
  return std::string(DIM_SOURCE_DIR) + "/tests/data/photometry/" + name;
}

dim::Photometry read(const std::string& name, dim::Warnings& warnings) {
  return dim::read_photometric_file(corpus(name), warnings);
}

dim::Photometry read(const std::string& name) {
  dim::Warnings warnings;
  return read(name, warnings);
}

double at_deg(const dim::Photometry& p, double c, double gamma) {
  return dim::IntensityTable(p.distribution).at_c_gamma(dim::radians(c), dim::radians(gamma));
}

struct Expected {
  const char* name;
  double flux_lm;
  int year;
  Symmetry symmetry;
  std::size_t n_warnings;
};

// Every plane of the corpus is constant in gamma, so flux = 2 pi (cos g0 - cos g1) x mean over C.
const double kHalf = 200 * kPi;
const Expected kReadable[] = {
    {"axial.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"quadrilateral.ies", 2.25 * kHalf, 2002, Symmetry::kQuadrilateral, 0},
    {"bilateral_0_180.ies", 2.25 * kHalf, 2002, Symmetry::kBilateral0_180, 0},
    {"bilateral_90_270.ies", 2.25 * kHalf, 2002, Symmetry::kBilateral90_270, 0},
    {"turn_0_360.ies", 2.5 * kHalf, 2002, Symmetry::kNone, 0},
    {"turn_without_360.ies", 2.5 * kHalf, 2002, Symmetry::kNone, 0},
    // 90 x 150 + 110 x 300 + 160 x 250 over 360
    {"turn_with_gap.ies", 86500.0 / 36000.0 * kHalf, 2002, Symmetry::kNone, 1},
    {"uplight_90_180.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"sphere_0_180.ies", 2 * kHalf, 2002, Symmetry::kAxial, 0},
    {"lm63_1986_no_identifier.ies", 0.9 * 0.95 * kHalf, 1986, Symmetry::kAxial, 0},
    {"lm63_1991_ballast_lamp_factor.ies", 2 * 0.9 * 0.95 * kHalf, 1991, Symmetry::kAxial, 0},
    {"lm63_1995_future_use.ies", 0.9 * kHalf, 1995, Symmetry::kAxial, 1},
    {"lm63_2002_future_use.ies", 0.9 * kHalf, 2002, Symmetry::kAxial, 1},
    {"lm63_2019_generation.ies", 0.9 * kHalf, 2019, Symmetry::kAxial, 0},
    {"lm63_2031_newer.ies", kHalf, 2019, Symmetry::kAxial, 1},
    {"multi_lamp_relative.ies", 1.5 * kHalf, 2002, Symmetry::kAxial, 1},
    {"relative_too_much_flux.ies", kHalf, 2002, Symmetry::kAxial, 1},
    {"absolute_declared_differs.ies", kHalf, 2002, Symmetry::kAxial, 1},
    {"tilt_include.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"tilt_file.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"dims_circle_negative.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"dims_circle_1995.ies", kHalf, 1995, Symmetry::kAxial, 0},
    {"dims_feet.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"dims_point.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"commas.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"wrapped.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"crlf.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"cr_only.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"bom.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"latin1_keyword.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"utf8_keyword.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"leading_blank_lines.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"lower_case.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"trailing_garbage.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"trailing_numbers.ies", kHalf, 2002, Symmetry::kAxial, 1},
    {"no_final_newline.ies", kHalf, 2002, Symmetry::kAxial, 0},
    {"old_number_forms.ies", kHalf, 2002, Symmetry::kAxial, 0},
};

struct Refused {
  const char* name;
  int line;
  const char* says;
};

const Refused kRefused[] = {
    {"bad_empty.ies", 1, "the file is empty"},
    {"bad_blank.ies", 4, "the file is empty"},
    {"bad_no_tilt.ies", 4, "no TILT= line"},
    {"bad_binary.ies", 3, "a zero byte"},
    {"bad_utf16.ies", 1, "UTF-16"},
    {"bad_truncated_candelas.ies", 11, "the file ends after 6 of 12 candela values"},
    {"bad_truncated_angles.ies", 7, "the file ends after 2 of 4 vertical angles"},
    {"bad_truncated_header.ies", 3, "the file ends before the photometric type"},
    {"bad_count_huge.ies", 5, "number of vertical angles 1000000000 is not a whole number within 2..36001"},
    {"bad_count_negative.ies", 5, "number of horizontal angles -3 is not a whole number within 1..36001"},
    {"bad_count_fraction.ies", 5, "number of vertical angles 4.5 is not a whole number"},
    {"bad_count_product.ies", 5, "36001 x 36001 candela values are more than"},
    {"bad_gamma_descending.ies", 7, "vertical angle 3 of 4: 30 follows 60"},
    {"bad_gamma_twice.ies", 7, "vertical angle 3 of 4: 30 follows 30"},
    {"bad_gamma_beyond_180.ies", 7, "vertical angle 4 of 4: 190 is outside 0..180"},
    {"bad_c_descending.ies", 8, "horizontal angle 3 of 3: 45 follows 90"},
    {"horizontal_0_45.ies", 8, "horizontal angles run from 0 to 45"},
    {"bad_nan.ies", 9, "candela value 2 of 4: 'nan' is not a finite number"},
    {"bad_inf.ies", 9, "candela value 3 of 4: 'inf' is not a finite number"},
    {"bad_overflow.ies", 9, "candela value 3 of 4: '1e999' is not a finite number"},
    {"bad_negative_candela.ies", 9, "candela value 2 of 4: -5 is outside 0..1e+18"},
    {"bad_word.ies", 9, "candela value 2 of 4: 'abc' is not a finite number"},
    {"bad_lumens.ies", 5, "lumens per lamp -2"},
    {"bad_multiplier_zero.ies", 5, "candela multiplier 0 is outside"},
    {"bad_units.ies", 5, "units type 3 is not a whole number within 1..2"},
    {"bad_type.ies", 5, "photometric type 7 is not a whole number within 1..3"},
    {"bad_decimal_comma.ies", 5, "number of vertical angles 0 is not a whole number"},
    {"bad_tilt_geometry.ies", 5, "TILT lamp-to-luminaire geometry 9 is not"},
};

}  // namespace

TEST_CASE("Every readable trap gives its flux, edition, symmetry and warnings", "[photometry][unit]") {
  for (const auto& expected : kReadable) {
    INFO(expected.name);
    dim::Warnings warnings;
    const auto p = read(expected.name, warnings);
    CHECK(p.flux_lm == Approx(expected.flux_lm).epsilon(1e-13));
    CHECK(p.format_year == expected.year);
    CHECK(p.symmetry == expected.symmetry);
    CHECK(warnings.size() == expected.n_warnings);
  }
}

TEST_CASE("Every unreadable trap is refused with its line, value and range", "[photometry][unit]") {
  for (const auto& expected : kRefused) {
    INFO(expected.name);
    try {
      read(expected.name);
      FAIL_CHECK("it was read");
    } catch (const dim::InputError& error) {
      CHECK(error.problems().front().place.line == expected.line);
      CHECK(error.problems().front().place.file == corpus(expected.name));
      CHECK_THAT(error.problems().front().what, Catch::Matchers::Contains(expected.says));
    }
  }
}

TEST_CASE("Reflections put each plane where the symmetry says", "[photometry][unit]") {
  const auto quadrilateral = read("quadrilateral.ies");
  for (const double c : {45.0, 135.0, 225.0, 315.0}) CHECK(at_deg(quadrilateral, c, 40) == Approx(200.0));
  CHECK(at_deg(quadrilateral, 270, 40) == Approx(400.0));
  CHECK(at_deg(quadrilateral, 180, 40) == Approx(100.0));
  const auto front_back = read("bilateral_0_180.ies");
  CHECK(at_deg(front_back, 90, 40) == Approx(200.0));
  CHECK(at_deg(front_back, 270, 40) == Approx(200.0));
  CHECK(at_deg(front_back, 180, 40) == Approx(400.0));
  const auto left_right = read("bilateral_90_270.ies");
  CHECK(at_deg(left_right, 0, 40) == Approx(200.0));
  CHECK(at_deg(left_right, 90, 40) == Approx(100.0));
  CHECK(at_deg(left_right, 270, 40) == Approx(400.0));
  CHECK(at_deg(left_right, 30, 40) == Approx(100.0 + 60.0 / 90 * 100));
  CHECK(at_deg(left_right, 330, 40) == Approx(200.0 + 30.0 / 90 * 200));
  const auto open = read("turn_without_360.ies");
  CHECK(at_deg(open, 315, 40) == Approx(200.0));
  CHECK(at_deg(open, 360, 40) == Approx(100.0));
  CHECK(at_deg(open, -45, 40) == Approx(200.0));
  CHECK(at_deg(open, 675, 40) == Approx(200.0));
}

TEST_CASE("Unequal vertical angles interpolate in their own intervals", "[photometry][unit]") {
  const auto p = read("unequal_angles.ies");
  CHECK(at_deg(p, 123, 0.5) == Approx(150.0));
  CHECK(at_deg(p, 123, 3) == Approx(250.0));
  CHECK(at_deg(p, 123, 60) == Approx(450.0));
  CHECK(at_deg(p, 123, 90.001) == 0.0);
}

TEST_CASE("The file generation type of LM-63-2019 is kept and is no factor", "[photometry][unit]") {
  const auto p = read("lm63_2019_generation.ies");
  CHECK(p.file_generation == 1.1);
  CHECK(p.ballast_factor == 0.9);
  CHECK(p.ballast_lamp_factor == 1.0);
  CHECK(p.max_cd == Approx(90.0));
}

TEST_CASE("Labels before TILT are kept in order as UTF-8", "[photometry][unit]") {
  CHECK(read("latin1_keyword.ies").keyword("MANUFAC") == "L\u00e4mpe \u2013 20\u00b0");
  CHECK(read("utf8_keyword.ies").keyword("MANUFAC") == "L\u00e4mpe \u2013 20\u00b0");
  const auto lower = read("lower_case.ies");
  CHECK(lower.keyword("TEST") == "small letters and more");
  CHECK(lower.keyword("MANUFAC") == "none");
  CHECK(lower.keyword("LUMCAT").empty());
  const auto old = read("lm63_1986_no_identifier.ies");
  REQUIRE(old.keywords.size() == 2);
  CHECK(old.keywords[1] == std::make_pair(std::string(), std::string("TILTED LAMP, 2 x 36 W")));
  CHECK(old.identifier.empty());
}

TEST_CASE("Tilt factors are kept, from the file or beside it", "[photometry][unit]") {
  const auto p = read("tilt_include.ies");
  REQUIRE(p.tilt);
  CHECK(p.tilt->geometry == 1);
  CHECK(p.tilt->factor == std::vector<double>{1, .97, .94, .90});
  CHECK(p.tilt->angle_rad.back() == Approx(kPi / 2));
  const auto q = read("tilt_file.ies");
  REQUIRE(q.tilt);
  CHECK(q.tilt->geometry == 2);
  CHECK(q.tilt->factor == std::vector<double>{1, 0.9, 0.8});
}

TEST_CASE("TILT=name without anywhere to look is an error with a cure", "[photometry][unit]") {
  const std::string text = "IESNA91\nTILT=lamp.tlt\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1 1\n";
  dim::Warnings warnings;
  try {
    dim::read_ies(text, "x.ies", warnings);
    FAIL("it was read");
  } catch (const dim::InputError& error) {
    CHECK(error.problems().front().place.line == 2);
    CHECK_THAT(error.problems().front().cure, Catch::Matchers::Contains("TILT=NONE"));
  }
}

TEST_CASE("Openings come in metres with length along C0", "[photometry][unit]") {
  const auto feet = read("dims_feet.ies");
  CHECK(feet.opening.width_m == Approx(0.6096));
  CHECK(feet.opening.length_m == Approx(1.2192));
  CHECK(read("dims_circle_negative.ies").opening.shape == dim::OpeningShape::kEllipse);
  CHECK(read("dims_circle_1995.ies").opening.length_m == Approx(0.2));
  CHECK(read("dims_point.ies").opening.shape == dim::OpeningShape::kPoint);
}

TEST_CASE("Lamp and luminaire lumens that disagree with the intensity are warned of with both figures",
          "[photometry][unit]") {
  dim::Warnings warnings;
  const auto relative = read("multi_lamp_relative.ies", warnings);
  CHECK(relative.declared_lamp_flux_lm == 750.0);
  CHECK_FALSE(relative.declared_flux_lm);
  const auto absolute = read("absolute_declared_differs.ies", warnings);
  CHECK(absolute.declared_flux_lm == 1000.0);
  CHECK_FALSE(absolute.declared_lamp_flux_lm);
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0].what, Catch::Matchers::Contains("942.478") && Catch::Matchers::Contains("750 lm"));
  CHECK_THAT(warnings[1].what,
             Catch::Matchers::Contains("628.319 lm") && Catch::Matchers::Contains("1000 lm (-37.2 %)"));
}

TEST_CASE("All negative candelas of a file are reported together", "[photometry][unit]") {
  try {
    read("bad_negative_candela.ies");
    FAIL("it was read");
  } catch (const dim::InputError& error) {
    REQUIRE(error.problems().size() == 2);
    CHECK(error.problems()[1].place.column == 12);
  }
}

TEST_CASE("Missing files, folders and oversized files are refused", "[photometry][unit]") {
  dim::Warnings warnings;
  CHECK_THROWS_AS(dim::read_photometric_file(corpus("not_there.ies"), warnings), dim::IoError);
  CHECK_THROWS_AS(dim::read_photometric_file(corpus(""), warnings), dim::IoError);
  const std::string line(dim::kMaxPhotometryBytes + 1, '1');
  CHECK_THROWS_AS(dim::read_ies(line, "big.ies", warnings), dim::InputError);
  const std::string widest = "TILT=NONE\n" + std::string(dim::kMaxPhotometryBytes - 10, '1');
  CHECK_THROWS_AS(dim::read_ies(widest, "big.ies", warnings), dim::InputError);
}

TEST_CASE("The fittings shipped with the program emit what their names say", "[photometry][unit]") {
  const std::string folder = std::string(DIM_SOURCE_DIR) + "/db/fittings/";
  dim::Warnings warnings;
  const auto troffer = dim::read_photometric_file(folder + "troffer-3600.ies", warnings);
  CHECK(troffer.flux_lm == Approx(3600.0).epsilon(1e-4));
  CHECK(troffer.watts == 33.0);
  CHECK(dim::area_m2(troffer.opening) == Approx(0.596 * 0.596));
  const auto batten = dim::read_photometric_file(folder + "batten-5200.ies", warnings);
  CHECK(batten.flux_lm == Approx(5200.0).epsilon(1e-4));
  CHECK(batten.opening.length_m == 1.2);
  CHECK(batten.symmetry == Symmetry::kNone);
  const auto downlight = dim::read_photometric_file(folder + "downlight-1100.ies", warnings);
  CHECK(downlight.flux_lm == Approx(1100.0).epsilon(1e-4));
  CHECK(downlight.opening.shape == dim::OpeningShape::kEllipse);
  CHECK(warnings.empty());
}
