#include <filesystem>

#include "catch.hpp"
#include "photometry/eulumdat.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/photometry_writer.hpp"

namespace {

using dim::OpeningShape;
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

// 100 cd on the hemisphere, all files of one trap but those that say otherwise.
constexpr double kFlux_lm = 200.0 * dim::kPi;

struct Readable {
  const char* name;
  Symmetry symmetry;
  std::size_t n_warnings;
};

const Readable kReadable[] = {
    {"ldt_isym0.ldt", Symmetry::kNone, 0},
    {"ldt_isym1.ldt", Symmetry::kAxial, 0},
    {"ldt_isym1_24_planes_of_zero.ldt", Symmetry::kAxial, 0},
    {"ldt_isym2.ldt", Symmetry::kBilateral0_180, 0},
    {"ldt_isym3.ldt", Symmetry::kBilateral90_270, 0},
    {"ldt_isym4.ldt", Symmetry::kQuadrilateral, 0},
    {"ldt_unequal_planes.ldt", Symmetry::kBilateral0_180, 0},
    {"ldt_closing_plane_360.ldt", Symmetry::kQuadrilateral, 0},
    {"ldt_decimal_comma.ldt", Symmetry::kAxial, 0},
    {"ldt_lamp_sets.ldt", Symmetry::kAxial, 1},
    {"ldt_absolute.ldt", Symmetry::kAxial, 1},
    {"ldt_conversion_factor.ldt", Symmetry::kAxial, 0},
    {"ldt_latin1.ldt", Symmetry::kAxial, 0},
    {"ldt_shift_jis.ldt", Symmetry::kAxial, 0},
    {"ldt_bom_crlf.ldt", Symmetry::kAxial, 0},
    {"ldt_cr_only.ldt", Symmetry::kAxial, 0},
    {"ldt_no_final_newline.ldt", Symmetry::kAxial, 0},
    {"ldt_empty_fields.ldt", Symmetry::kAxial, 0},
    {"ldt_disc.ldt", Symmetry::kAxial, 0},
    {"ldt_point.ldt", Symmetry::kAxial, 0},
    {"ldt_tilted.ldt", Symmetry::kAxial, 1},
    {"ldt_declared_differs.ldt", Symmetry::kAxial, 1},
};

struct Refused {
  const char* name;
  int line;
  const char* says;
};

const Refused kRefused[] = {
    {"bad_ldt_empty.ldt", 1, "the file ends before the identification"},
    {"bad_ldt_binary.ldt", 1, "a zero byte"},
    {"bad_ldt_isym.ldt", 3, "symmetry indicator Isym 5 is outside 0..4"},
    {"bad_ldt_planes_zero.ldt", 4, "number of C planes Mc 0 is outside 1..36001"},
    {"bad_ldt_gammas_one.ldt", 6, "number of intensities in a plane Ng 1 is outside 2..36001"},
    {"bad_ldt_huge.ldt", 7, "36001 x 36001 intensities are more than"},
    {"bad_ldt_lamp_sets_21.ldt", 26, "number of sets of lamps 21 is outside 1..20"},
    {"bad_ldt_no_flux.ldt", 29, "total luminous flux of lamps 0 is not above 0"},
    {"bad_ldt_flux_word.ldt", 29, "total luminous flux of lamps: 'about 1000' is not a finite number"},
    {"bad_ldt_cut_header.ldt", 21, "the file ends before the height of the luminous area in C270"},
    {"bad_ldt_cut_lamps.ldt", 28, "the file ends before the type of lamps"},
    {"bad_ldt_cut_angles.ldt", 45, "the file ends before the angle gamma 2 of 4"},
    {"bad_ldt_cut_intensities.ldt", 50, "the file ends before the intensity 3 of 4"},
    {"bad_ldt_negative.ldt", 51, "intensity 4 of 4 -5 is outside 0..1e+18"},
    {"bad_ldt_nan.ldt", 51, "intensity 4 of 4: 'nan' is not a finite number"},
    {"bad_ldt_overflow.ldt", 51, "intensity 4 of 4: '1e999' is not a finite number"},
    {"bad_ldt_large.ldt", 51, "intensity 1e+18 cd/klm x 1000000 is outside"},
    {"bad_ldt_two_commas.ldt", 51, "intensity 4 of 4: '1,000,0' is not a finite number"},
    {"bad_ldt_empty_intensity.ldt", 51, "intensity 4 of 4: '' is not a finite number"},
    {"bad_ldt_gamma_descending.ldt", 47, "angle gamma 4 of 4: 10 follows 60"},
    {"bad_ldt_gamma_190.ldt", 47, "angle gamma 4 of 4 190 is outside 0..180"},
    {"bad_ldt_planes_descending.ldt", 45, "C plane 3 of 4: 80 follows 90"},
    {"bad_ldt_isym3_without_270.ldt", 3, "Isym 3 does not go with the file's C planes"},
    {"bad_ldt_isym2_without_180.ldt", 3, "Isym 2 does not go with the file's C planes"},
    {"bad_ldt_isym0_half_turn.ldt", 3, "Isym 0 does not go with the file's C planes"},
};

double at(const dim::Photometry& p, double c_deg, double gamma_deg) {
  return dim::IntensityTable(p.distribution).at_c_gamma(dim::radians(c_deg), dim::radians(gamma_deg));
}

}  // namespace

TEST_CASE("Every readable EULUMDAT trap gives its flux, symmetry and warnings", "[photometry][unit]") {
  for (const auto& expected : kReadable) {
    INFO(expected.name);
    dim::Warnings warnings;
    const auto p = read(expected.name, warnings);
    CHECK(p.flux_lm == Approx(kFlux_lm).epsilon(1e-12));
    CHECK(p.symmetry == expected.symmetry);
    CHECK(p.format_year == 0);
    CHECK(warnings.size() == expected.n_warnings);
  }
}

TEST_CASE("Every unreadable EULUMDAT trap is refused with its line, value and range", "[photometry][unit]") {
  for (const auto& expected : kRefused) {
    INFO(expected.name);
    try {
      read(expected.name);
      FAIL_CHECK("it was read");
    } catch (const dim::InputError& error) {
      const auto& problem = error.problems().front();
      CHECK(problem.place.line == expected.line);
      CHECK(problem.place.file == corpus(expected.name));
      CHECK_THAT(problem.what, Catch::Matchers::Contains(expected.says));
    }
  }
}

TEST_CASE("EULUMDAT planes are listed from C0, with Isym 3 from C270", "[photometry][unit]") {
  const auto none = read("ldt_isym0.ldt");
  CHECK(at(none, 0, 40) == Approx(70));
  CHECK(at(none, 90, 40) == Approx(90));
  CHECK(at(none, 180, 40) == Approx(110));
  CHECK(at(none, 270, 40) == Approx(130));
  CHECK(at(none, 315, 40) == Approx(100));  // between C270 and C0
  const auto about_c0 = read("ldt_isym2.ldt");
  CHECK(at(about_c0, 0, 40) == Approx(70));
  CHECK(at(about_c0, 90, 40) == Approx(100));
  CHECK(at(about_c0, 270, 40) == Approx(100));
  CHECK(at(about_c0, 180, 40) == Approx(130));
  const auto about_c90 = read("ldt_isym3.ldt");
  CHECK(at(about_c90, 270, 40) == Approx(130));
  CHECK(at(about_c90, 0, 40) == Approx(100));
  CHECK(at(about_c90, 180, 40) == Approx(100));
  CHECK(at(about_c90, 90, 40) == Approx(70));
  const auto quarter = read("ldt_isym4.ldt");
  for (const double c : {45.0, 135.0, 225.0, 315.0}) CHECK(at(quarter, c, 40) == Approx(100));
  for (const double c : {90.0, 270.0}) CHECK(at(quarter, c, 40) == Approx(130));
}

TEST_CASE("EULUMDAT dimensions run along C90-C270, and no width means round", "[photometry][unit]") {
  const auto rectangle = read("ldt_isym1.ldt").opening;
  CHECK(rectangle.shape == OpeningShape::kRectangle);
  CHECK(rectangle.width_m == Approx(0.5));
  CHECK(rectangle.length_m == Approx(0.4));
  const auto disc = read("ldt_disc.ldt").opening;
  CHECK(disc.shape == OpeningShape::kEllipse);
  CHECK(disc.width_m == Approx(0.25));
  CHECK(disc.length_m == Approx(0.25));
  const auto cylinder = read("ldt_upright_cylinder.ldt").opening;
  CHECK(cylinder.shape == OpeningShape::kVerticalCylinder);
  CHECK(cylinder.height_m == Approx(0.08));
  CHECK(read("ldt_point.ldt").opening.shape == OpeningShape::kPoint);
}

TEST_CASE("EULUMDAT lamps: the flux is the set's, the first set is used", "[photometry][unit]") {
  dim::Warnings warnings;
  const auto sets = read("ldt_lamp_sets.ldt", warnings);
  CHECK(sets.lamp_sets.size() == 2);
  CHECK(sets.n_lamps == 2);
  CHECK(sets.lumens_per_lamp == 500.0);
  CHECK(sets.declared_lamp_flux_lm == 1000.0);
  CHECK(sets.watts == 60.0);
  CHECK_THAT(warnings.front().what, Catch::Matchers::Contains("the first is used ('T5 28W' of 1000 lm)"));
  const auto absolute = read("ldt_absolute.ldt");
  CHECK_FALSE(absolute.lumens_per_lamp);
  CHECK_FALSE(absolute.declared_lamp_flux_lm);
  CHECK(absolute.declared_flux_lm == 1000.0);
}

TEST_CASE("EULUMDAT text comes out as UTF-8 whatever it was written in", "[photometry][unit]") {
  CHECK(read("ldt_latin1.ldt").keyword("LUMINAIRE") == "Büroleuchte für 2 Lampen");
  CHECK(read("ldt_shift_jis.ldt").keyword("LUMINAIRE") == "照明器具 表示灯");
  CHECK(read("ldt_bom_crlf.ldt").keyword("LUMINAIRE") == "Büro");
}

TEST_CASE("A luminaire keeps lamps, size and names through an EULUMDAT file", "[photometry][unit]") {
  dim::Warnings warnings;
  for (const char* name :
       {"ldt_isym1.ldt", "ldt_absolute.ldt", "ldt_disc.ldt", "ldt_upright_cylinder.ldt", "ldt_point.ldt",
        "multi_lamp_relative.ies", "quadrilateral.ies", "dims_feet.ies"}) {
    INFO(name);
    const auto p = read(name);
    const auto q = dim::read_photometry(dim::eulumdat_text(p, warnings), "x.ldt", warnings);
    CHECK(q.n_lamps == p.n_lamps);
    CHECK(q.lumens_per_lamp.value_or(-1) == Approx(p.lumens_per_lamp.value_or(-1)));
    CHECK(q.symmetry == p.symmetry);
    CHECK(q.opening.shape == p.opening.shape);
    CHECK(q.opening.length_m == Approx(p.opening.length_m));
    CHECK(q.opening.width_m == Approx(p.opening.width_m));
    CHECK(q.opening.height_m == Approx(p.opening.height_m));
    CHECK(q.keyword("LUMINAIRE") == p.keyword("LUMINAIRE"));
    CHECK(q.keyword("LAMP") == p.keyword("LAMP"));
  }
}
