#include "base/input_file.hpp"
#include "catch.hpp"
#include "photometry/photometry_file.hpp"

// Forms of photometric files that occur and that the standards do not have.
namespace {

using dim::kPi;

dim::Photometry read(const std::string& text, const std::string& name, dim::Warnings& warnings,
                     const dim::TiltResolver& resolver = {}) {
  return dim::read_photometry(text, name, warnings, resolver);
}

dim::Problem refusal(const std::string& text, const std::string& name,
                     const dim::TiltResolver& resolver = {}) {
  dim::Warnings warnings;
  try {
    read(text, name, warnings, resolver);
  } catch (const dim::InputError& error) {
    return error.problems().front();
  }
  return {};
}

std::string ies(const std::string& identifier, const std::string& tilt, const std::string& numbers) {
  return identifier + "\n[TEST] X\nTILT=" + tilt + "\n" + numbers;
}

const std::string kEven = "1 -1 1 2 1 1 2 0 0 0\n1 1.1 10\n0 90\n0\n100 100\n";

std::string corpus(const std::string& name) {
  return dim::read_text_file(std::string(DIM_SOURCE_DIR) + "/tests/data/photometry/" + name, 1 << 20);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("The edition is found in every form of the first line", "[photometry][unit]") {
  struct Case {
    const char* identifier;
    int year;
    double cd;
  };
  // The third number of the ballast line is a factor in 1986 and 1991 alone.
  const Case cases[] = {{"IESNA: LM-63-2002", 2002, 100}, {"IESNA: LM-63-1991", 1991, 110},
                        {"IESNA 91", 1991, 110},          {"IESNA91", 1991, 110},
                        {"ANSI/IES LM-63-19", 2019, 100}, {"ANSI/IESNA LM-63-02", 2002, 100},
                        {"IES:LM-63-2019", 2019, 100},    {"iesna:lm-63-1995", 1995, 100}};
  for (const auto& expected : cases) {
    INFO(expected.identifier);
    dim::Warnings warnings;
    const auto p = read(ies(expected.identifier, "NONE", kEven), "a.ies", warnings);
    CHECK(p.format_year == expected.year);
    CHECK(p.max_cd == Approx(expected.cd));
  }
}

TEST_CASE("TILT=NONE; and TILT=FILE name are understood", "[photometry][unit]") {
  dim::Warnings warnings;
  CHECK_FALSE(read(ies("IESNA:LM-63-1995", "NONE;", kEven), "a.ies", warnings).tilt.has_value());
  const dim::TiltResolver lamp = [](const std::string& name) {
    return name == "lamp.tlt" ? std::string("1\n2\n0 90\n1 0.8\n") : std::string("?");
  };
  for (const char* form : {"FILE lamp.tlt", "lamp.tlt", "\"lamp.tlt\"", "file lamp.tlt"}) {
    INFO(form);
    const auto p = read(ies("IESNA:LM-63-1995", form, kEven), "a.ies", warnings, lamp);
    REQUIRE(p.tilt.has_value());
    CHECK(dim::tilt_factor(*p.tilt, kPi / 4) == Approx(0.9));
  }
}

TEST_CASE("A TILT line that cannot be followed is refused at its place", "[photometry][unit]") {
  struct Case {
    const char* tilt;
    const char* says;
  };
  const dim::TiltResolver none = [](const std::string& name) -> std::string {
    throw dim::IoError(name, "gone");
  };
  const Case cases[] = {{"NONE 1 -1 1 3 1 1 2 0 0 0", "TILT=NONE is followed by '1 -1 1 3 1 1 2 0 0 0'"},
                        {"lamp.tlt", "TILT=lamp.tlt: there is no such file beside this one"},
                        {"/etc/passwd", "names another folder"},
                        {"../lamp.tlt", "names another folder"},
                        {"C:\\ies\\lamp.tlt", "names another folder"},
                        {"..", "names another folder"}};
  for (const auto& expected : cases) {
    INFO(expected.tilt);
    const auto problem = refusal(ies("IESNA:LM-63-1995", expected.tilt, kEven), "a.ies", none);
    CHECK(problem.place.file == "a.ies");
    CHECK(problem.place.line == 3);
    CHECK(problem.what.find(expected.says) != std::string::npos);
    CHECK_FALSE(problem.cure.empty());
  }
}

TEST_CASE("What a TILT file holds is not quoted", "[photometry][unit]") {
  const dim::TiltResolver secret = [](const std::string&) {
    return std::string("1\n2\n0 90\n1 topsecret\n");
  };
  const auto problem = refusal(ies("IESNA:LM-63-1995", "lamp.tlt", kEven), "a.ies", secret);
  CHECK(problem.what == "TILT=lamp.tlt: line 4 of that file is not lamp tilt data");
  CHECK(problem.cure.find("secret") == std::string::npos);
}

TEST_CASE("Gamma that stops short of a hemisphere's end is carried on and warned of", "[photometry][unit]") {
  struct Case {
    const char* numbers;  // counts of angles, angles, values
    double flux_lm;
    std::size_t n_warnings;
  };
  // 100 cd everywhere that is listed or carried on to.
  const Case cases[] = {{"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n2.5 45 87.5\n0\n100 100 100\n", 200 * kPi, 2},
                        {"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n2.5 90 177.5\n0\n100 100 100\n", 400 * kPi, 2},
                        {"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n92.5 120 180\n0\n100 100 100\n", 200 * kPi, 1},
                        {"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 100 100\n", 200 * kPi, 0},
                        // Nothing is left at the end: it stays dark beyond.
                        {"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 60 60.001\n0\n100 100 0\n", 100 * kPi, 0}};
  for (const auto& expected : cases) {
    INFO(expected.numbers);
    dim::Warnings warnings;
    const auto p = read(ies("IESNA:LM-63-2002", "NONE", expected.numbers), "a.ies", warnings);
    CHECK(p.flux_lm == Approx(expected.flux_lm).epsilon(2e-5));
    CHECK(warnings.size() == expected.n_warnings);
    for (const auto& warning : warnings) CHECK(warning.place.line == 6);
  }
}

TEST_CASE("In types A and B it is said which half of one-sided vertical angles is read",
          "[photometry][unit]") {
  dim::Warnings warnings;
  const auto p =
      read(ies("IESNA:LM-63-2002", "NONE", "1 -1 1 2 2 2 2 0 0 0\n1 1 10\n0 90\n0 90\n100 100 100 100\n"),
           "b.ies", warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what ==
        "vertical angles run from 0 to 90: read as the upper half alone, no light leaves on the "
        "other side of the aim");
  CHECK(warnings[0].cure.find("list both halves") != std::string::npos);
  // A quarter of the sphere: V 0..90, H -90..90.
  CHECK(p.flux_lm == Approx(100 * kPi));
}

TEST_CASE("Planes that EULUMDAT's Isym does not ask for are warned of", "[photometry][unit]") {
  std::string text = corpus("ldt_isym0.ldt");
  const auto isym = [&](char digit) {
    std::string changed = text;
    std::size_t at = 0;
    for (int line = 1; line < 3; ++line) at = changed.find('\n', at) + 1;
    changed[at] = digit;
    return changed;
  };
  // Four planes of four values; Isym 1 lists one of them, 4 two.
  for (const auto& [digit, says] : {std::pair{'1',
                                              "12 more numbers after the intensities of the 1 plane that "
                                              "Isym 1 lists: ignored (3 more planes)"},
                                    std::pair{'4',
                                              "8 more numbers after the intensities of the 2 planes that "
                                              "Isym 4 lists: ignored (2 more planes)"}}) {
    dim::Warnings warnings;
    read(isym(digit), "s.ldt", warnings);
    bool said = false;
    for (const auto& warning : warnings) said = said || warning.what == says;
    INFO(digit);
    for (const auto& warning : warnings) INFO(warning.what);
    CHECK(said);
  }
  dim::Warnings warnings;
  read(text + "\r\n\r\n", "s.ldt", warnings);
  CHECK(warnings.empty());
}

TEST_CASE("Lines that end in CR CR LF are single lines", "[photometry][unit]") {
  for (const char* name : {"ldt_isym2.ldt", "ldt_empty_fields.ldt", "quadrilateral.ies"}) {
    INFO(name);
    const std::string plain = replaced(corpus(name), "\r\n", "\n");
    dim::Warnings warnings;
    const auto expected = read(plain, name, warnings);
    const auto p = read(replaced(plain, "\n", "\r\r\n"), name, warnings);
    CHECK(p.flux_lm == expected.flux_lm);
    CHECK(p.keywords == expected.keywords);
    CHECK(p.distribution.intensity_cd == expected.distribution.intensity_cd);
  }
}

TEST_CASE("Files of other programs are named as what they are", "[photometry][unit]") {
  CHECK(dim::foreign_format("a/lamp.GLDF").what == "a GLDF container (zip)");
  CHECK(dim::foreign_format("lamp.uld").what.find("DIALux") != std::string::npos);
  CHECK(dim::foreign_format("lamp.ies").what.empty());
  CHECK(dim::is_photometric_name("lamp.XML"));
}
