#include <filesystem>
#include <fstream>
#include <map>

#include "scene/lights_reader.hpp"
#include "scene_support.hpp"
#include "spectrum/named_spectra.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// 100 cd at nadir falling linearly to 0 at 90 degrees, no light above; square opening 0.6 m.
const std::string kIes =
    "IESNA:LM-63-2002\n[TEST] self-made\nTILT=NONE\n1 -1 1 3 1 1 2 0.6 0.6 0\n1 1 30\n0 45 90\n0\n100 50 0\n";

const std::map<std::string, std::string> kFiles = {
    {"lamps/a.ies", kIes},
    {"lamps/bad.ies",
     "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.6 0.6 0\n1 1 30\n0 45 90\n0\n100 x 0\n"}};

std::string load(const std::string& path) {
  const auto found = kFiles.find(path);
  if (found == kFiles.end()) throw IoError(path, "No such file or directory");
  return found->second;
}

Lights lights(const std::string& text, const std::vector<std::string>& overrides = {},
              Warnings* warnings = nullptr, const std::string& zone_text = kRoom) {
  Warnings own;
  const DatabaseSearch search{{std::string(DIM_SOURCE_DIR) + "/db"}};
  const Zone zone = read(zone_text);
  const FileLoader loader = [](const std::string& path) {
    return path.starts_with("lamps/") ? load(path) : load_from_disk()(path);
  };
  return read_lights(text, "lamps/lights.toml", overrides, zone, search, warnings ? *warnings : own, loader);
}

std::vector<std::string> light_problems(const std::string& text,
                                        const std::vector<std::string>& overrides = {}) {
  try {
    lights(text, overrides);
  } catch (const InputError& error) {
    std::vector<std::string> result;
    for (const auto& p : error.problems()) result.push_back(to_string(p));
    return result;
  }
  return {};
}

std::string one(const std::string& more) {
  return "dim = \"lights/1\"\n[[luminaire]]\nname = \"A1\"\n" + more + "\n";
}

void check_one(const std::vector<std::string>& problems, const std::string& expected) {
  REQUIRE(problems.size() == 1);
  CHECK(problems[0] == expected);
}

bool near(const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-14; }

}  // namespace

TEST_CASE("A luminaire from an .ies beside the lights file", "[scene][lights][unit]") {
  Warnings warnings;
  const Lights result = lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]\ndim = 0.5"), {}, &warnings);
  REQUIRE(result.luminaires.size() == 1);
  const Luminaire& a = result.luminaires[0];
  CHECK(a.name == "A1");
  CHECK(a.group == "A1");
  CHECK(near(a.at, Vec3(1, 1, 2.5) - Vec3(3, 2, 1.5)));
  CHECK(a.factor == 0.5);
  CHECK(a.opening.shape == OpeningShape::kRectangle);
  CHECK(a.opening.length_m == Approx(0.6));
  CHECK_FALSE(a.body);
  const Fitting& fitting = result.fittings[static_cast<std::size_t>(a.fitting)];
  CHECK(fitting.name == "a.ies");
  CHECK(fitting.watts == 30);
  CHECK(fitting.intensity.at({0, 0, 1}) == Approx(100));
  // I = 100 (1 - 2 gamma / pi): flux = 2 pi 100 (integral of sin - (2/pi) integral of gamma sin) = 200 pi (1
  // - 2/pi).
  CHECK(fitting.flux_lm == Approx(200 * kPi * (1 - 2 / kPi)).epsilon(1e-9));
  CHECK_FALSE(fitting.has_spectrum);
  CHECK(fitting.spectrum.at(500) == 1.0);
  CHECK(warnings.empty());
}

TEST_CASE("The axes: C90 = C0 x aim, and turn goes from C0 towards C90", "[scene][lights][unit]") {
  const auto axes = [](const std::string& more) {
    return lights(one("ideal = \"lambertian\"\nintensity = 1\nat = [1,1,2]\n" + more)).luminaires[0];
  };
  const Luminaire down = axes("");
  CHECK(near(down.aim, {0, 0, -1}));
  CHECK(near(down.c0, {1, 0, 0}));
  CHECK(near(down.c90, {0, 1, 0}));
  const Luminaire quarter = axes("turn = 90");
  CHECK(near(quarter.c0, {0, 1, 0}));
  CHECK(near(quarter.c90, {-1, 0, 0}));
  const Luminaire up = axes("aim = [0,0,2]");
  CHECK(near(up.c0, {1, 0, 0}));
  CHECK(near(up.c90, {0, -1, 0}));
  const Luminaire along_x = axes("aim = [-1,0,0]");
  CHECK(near(along_x.c0, {0, 1, 0}));
  CHECK(near(along_x.c90, glm::cross(Vec3(0, 1, 0), Vec3(-1, 0, 0))));
  const Luminaire oblique = axes("aim = [1,0,-1]\nc0 = [0,0,5]");
  CHECK(near(oblique.c0, glm::normalize(Vec3(1, 0, 1))));
  CHECK(near(oblique.to_world({0, 0, 1}), oblique.aim));
  CHECK(near(oblique.to_local(oblique.c90), {0, 1, 0}));
}

TEST_CASE("An array names its luminaires by index and groups them by its name", "[scene][lights][unit]") {
  const Lights result = lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]\ncount = [3,2]\npitch = [2,1.5]"));
  REQUIRE(result.luminaires.size() == 6);
  CHECK(result.fittings.size() == 1);
  CHECK(result.luminaires[0].name == "A1[0,0]");
  CHECK(result.luminaires[2].name == "A1[2,0]");
  CHECK(result.luminaires[5].name == "A1[2,1]");
  CHECK(result.luminaires[5].group == "A1");
  CHECK(near(result.luminaires[5].at - result.luminaires[0].at, {4, 1.5, 0}));
}

TEST_CASE("Ideal sources by intensity or by lumens", "[scene][lights][unit]") {
  const auto flux = [](const std::string& more) {
    const Lights result = lights(one("at = [2,2,2]\n" + more));
    const Luminaire& a = result.luminaires[0];
    return a.factor * result.fittings[static_cast<std::size_t>(a.fitting)].flux_lm;
  };
  CHECK(flux("ideal = \"isotropic\"\nintensity = 100") == Approx(400 * kPi));
  CHECK(flux("ideal = \"isotropic\"\nlumens = 1000") == Approx(1000));
  CHECK(flux("ideal = \"lambertian\"\nintensity = 100") == Approx(100 * kPi));
  CHECK(flux("ideal = \"lambertian\"\nlumens = 1000\ndim = 0.25") == Approx(250));
  CHECK(flux("ideal = \"isotropic\"\nintensity = 0") == 0);
  CHECK(flux("fitting = \"a.ies\"\nlumens = 1234") == Approx(1234));
}

TEST_CASE("The opening may be the file's, a point or a rectangle in the zone's unit",
          "[scene][lights][unit]") {
  const auto opening = [](const std::string& more) {
    return lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]\n" + more)).luminaires[0].opening;
  };
  CHECK(opening("opening = \"file\"").shape == OpeningShape::kRectangle);
  CHECK(opening("opening = \"point\"").shape == OpeningShape::kPoint);
  CHECK(opening("opening = [1.2, 0.3]").length_m == 1.2);
  CHECK(opening("opening = [1.2, 0.3]").width_m == 0.3);
  CHECK(opening("opening = [1.2, 0]").shape == OpeningShape::kLine);
  CHECK(opening("opening = [0, 0]").shape == OpeningShape::kPoint);
}

TEST_CASE("Positions and openings are in the zone file's unit", "[scene][lights][unit]") {
  std::string millimetres = kRoom;
  for (std::size_t at = millimetres.find("vertices"); at != std::string::npos;
       at = millimetres.find("vertices", at + 1))
    for (std::size_t i = at; millimetres[i] != '\n'; ++i)
      if (std::isdigit(static_cast<unsigned char>(millimetres[i])) && millimetres[i] != '0')
        millimetres.insert(i + 1, "000"), i += 3;
  millimetres.insert(millimetres.find("cell"), "unit = \"mm\"\n");
  const Lights result = lights(one("fitting = \"a.ies\"\nat = [1000,1000,2500]\nopening = [1200, 300]"), {},
                               nullptr, millimetres);
  CHECK(glm::length(result.luminaires[0].at - Vec3(-2, -1, 1)) < 1e-12);
  CHECK(result.luminaires[0].opening.length_m == Approx(1.2));
}

TEST_CASE("A database entry gives photometry, watts and suggestions for a misspelt name",
          "[scene][lights][unit]") {
  const Lights result = lights(one("fitting = \"troffer-3600\"\nat = [1,1,2.5]"));
  CHECK(result.fittings[0].name == "troffer-3600");
  CHECK(result.fittings[0].watts == 33);
  CHECK(result.fittings[0].flux_lm == Approx(3600).epsilon(0.01));
  const auto problems = light_problems(one("fitting = \"trofer-3600\"\nat = [1,1,2.5]"));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].starts_with("lamps/lights.toml:4:11: luminaire 'A1': no fitting 'trofer-3600' in "));
  CHECK(problems[0].ends_with("\n        did you mean 'troffer-3600'?"));
}

TEST_CASE("--set reaches a luminaire by its name", "[scene][lights][unit]") {
  CHECK(lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]"), {"luminaire.A1.dim=0.5"}).luminaires[0].factor ==
        0.5);
}

TEST_CASE("A spectrum of its own makes a fitting of its own", "[scene][lights][unit]") {
  const Lights result =
      lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]") +
             "[[luminaire]]\nname = \"A2\"\nfitting = \"a.ies\"\nat = [2,1,2.5]\nspectrum = "
             "[[400,1],[700,2]]\n");
  CHECK(result.luminaires[0].fitting != result.luminaires[1].fitting);
  const Fitting& second = result.fittings[static_cast<std::size_t>(result.luminaires[1].fitting)];
  CHECK(second.has_spectrum);
  CHECK(second.spectrum.at(550) == Approx(1.5));
}

TEST_CASE("A spectrum by name is that spectrum; an unknown name is an error", "[scene][lights][unit]") {
  Warnings warnings;
  const std::string lamp = "fitting = \"a.ies\"\nat = [1,1,2.5]\n";
  const Lights result = lights(one(lamp + "spectrum = \"led-b3\""), {}, &warnings);
  CHECK(warnings.empty());
  const Fitting& fitting = result.fittings[static_cast<std::size_t>(result.luminaires[0].fitting)];
  CHECK(fitting.has_spectrum);
  CHECK(fitting.spectrum_name == "led-b3");
  CHECK(fitting.spectrum.points() == find_spectrum("led-b3").points());
  check_one(light_problems(one(lamp + "spectrum = \"led-b33\"")),
            "lamps/lights.toml:6:12: luminaire 'A1': no spectrum is called 'led-b33'\n        did you mean "
            "'led-b3'?");
}

TEST_CASE("A recessed luminaire in the ceiling is fine, a bare bulb on it is warned of",
          "[scene][lights][unit]") {
  Warnings warnings;
  lights(one("fitting = \"a.ies\"\nat = [1,1,3]"), {}, &warnings);
  CHECK(warnings.empty());
  lights(one("ideal = \"isotropic\"\nintensity = 1\nat = [1,1,3]"), {}, &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(
      to_string(warnings[0]) ==
      "lamps/lights.toml:6:6: luminaire 'A1' lies on surface 'ceiling': light it sends behind that is lost\n"
      "        move it a little into the zone");
}

TEST_CASE("A body is black or has a reflectance", "[scene][lights][bodies][unit]") {
  const std::string lamp = "fitting = \"a.ies\"\nat = [1,1,2.5]\n";
  const auto body = [&](const std::string& more) { return lights(one(lamp + more)).luminaires[0]; };
  CHECK_FALSE(body("body = false").body);
  CHECK(body("body = true").body);
  CHECK(body("body = true").body_reflectance == 0.0);
  CHECK(body("body = { reflectance = 0.5 }").body);
  CHECK(body("body = { reflectance = 0.5 }").body_reflectance == 0.5);
  const auto set = lights(one(lamp + "body = { reflectance = 0.5 }"), {"luminaire.A1.body.reflectance=0.25"});
  CHECK(set.luminaires[0].body_reflectance == 0.25);
  check_one(light_problems(one(lamp + "body = 0.5")),
            "lamps/lights.toml:6:8: luminaire 'A1': body must be true, false or a table\n"
            "        write true for a black body, or { reflectance = 0.5 }");
  check_one(light_problems(one(lamp + "body = { reflectance = 50 }")),
            "lamps/lights.toml:6:24: luminaire 'A1', body: reflectance must be at least 0 and less than 1, not "
            "50");
  check_one(light_problems(one(lamp + "body = {}")),
            "lamps/lights.toml:6:8: luminaire 'A1', body: 'reflectance' is missing\n"
            "        write body = true for a black one");
  check_one(light_problems(one(lamp + "body = { reflectance = 0.5, colour = 1 }")),
            "lamps/lights.toml:6:29: luminaire 'A1', body: unknown key 'colour'");
}

TEST_CASE("A body without an opening is warned of", "[scene][lights][bodies][unit]") {
  Warnings warnings;
  lights(one("fitting = \"a.ies\"\nat = [1,1,2.5]\nopening = \"point\"\nbody = true"), {}, &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(to_string(warnings[0]) ==
        "lamps/lights.toml:7:8: luminaire 'A1': its opening has no area, so that it has no body\n"
        "        give its size: opening = [length, width]");
}

TEST_CASE("A luminaire recessed in the ceiling makes room for its body", "[scene][lights][bodies][unit]") {
  const std::string lamp = "fitting = \"a.ies\"\nat = [1,1,3]\n";
  CHECK(lights(one(lamp)).luminaires[0].at.z == Approx(1.5).epsilon(1e-14));
  CHECK(lights(one(lamp + "body = true")).luminaires[0].at.z == Approx(1.5 - 2e-4).epsilon(1e-14));
}

TEST_CASE("Wrong luminaires are refused with place and cure", "[scene][lights][unit]") {
  const std::string lamp = "fitting = \"a.ies\"\nat = [1,1,2.5]\n";
  check_one(light_problems(one("fitting = \"a.ies\"\nat = [1,1,3.5]")),
            "lamps/lights.toml:5:6: luminaire 'A1' at (1, 1, 3.5) is outside the zone, which reaches from "
            "(0, 0, 0) to "
            "(6, 4, 3)\n        positions are in the zone file's unit");
  check_one(light_problems(one(lamp + "dim = -0.5")),
            "lamps/lights.toml:6:7: luminaire 'A1': dim must be at least 0, not -0.5");
  check_one(light_problems(one(lamp + "dim = nan")),
            "lamps/lights.toml:6:7: luminaire 'A1': dim must be finite, not nan");
  check_one(light_problems(one(lamp + "aim = [0,0,0]")),
            "lamps/lights.toml:6:7: luminaire 'A1': aim has zero length");
  check_one(light_problems(one(lamp + "c0 = [0,0,1]")),
            "lamps/lights.toml:6:6: luminaire 'A1': c0 is parallel to aim\n        C = 0 is a direction "
            "across the aim");
  check_one(light_problems(one(lamp + "count = [2,2]")),
            "lamps/lights.toml:6:9: luminaire 'A1': an array of luminaires needs both count and pitch\n"
            "        write pitch = [step along x, step along y]");
  check_one(light_problems(one(lamp + "count = [0,2]\npitch = [1,1]")),
            "lamps/lights.toml:6:10: luminaire 'A1': count must be 1 to 10000, not 0");
  check_one(
      light_problems(one(lamp + "count = [10000,10000]\npitch = [0,0]")),
      "lamps/lights.toml:6:9: luminaire 'A1': count = [10000, 10000] makes 100000000 luminaires; a file "
      "has at most 100000\n        use fewer, or one luminaire of the same total flux for several");
  check_one(light_problems(one(lamp + "intensity = 5")),
            "lamps/lights.toml:6:13: luminaire 'A1': intensity belongs to an ideal source\n        use "
            "lumens or dim");
  check_one(light_problems(one(lamp + "ideal = \"isotropic\"")),
            "lamps/lights.toml:6:9: luminaire 'A1': both fitting and ideal are given\n        give a "
            "fitting, or ideal = "
            "\"isotropic\" or \"lambertian\"");
  check_one(light_problems(one("at = [1,1,1]")),
            "lamps/lights.toml:3:8: luminaire 'A1': 'fitting' is missing\n        give a fitting, or ideal = "
            "\"isotropic\" or \"lambertian\"");
  check_one(light_problems(one("at = [1,1,1]\nideal = \"isotropic\"")),
            "lamps/lights.toml:5:9: luminaire 'A1': an ideal source needs its intensity (cd) or lumens");
  check_one(
      light_problems(one("at = [1,1,1]\nideal = \"lambert\"\nlumens = 1")),
      "lamps/lights.toml:5:9: luminaire 'A1': ideal must be one of isotropic, lambertian, not 'lambert'");
  check_one(light_problems(one(lamp + "opening = \"round\"")),
            "lamps/lights.toml:6:11: luminaire 'A1': opening must be one of file, point, not 'round'");
  check_one(light_problems(one(lamp + "opening = [-1, 1]")),
            "lamps/lights.toml:6:12: luminaire 'A1': opening must be 0 to 1e+12, not -1");
  check_one(light_problems(one(lamp + "colour = 3")),
            "lamps/lights.toml:6:1: luminaire 'A1': unknown key 'colour'");
  check_one(light_problems(one(lamp + "[[luminaire]]\nname = \"A1\"\n" + lamp)),
            "lamps/lights.toml:7:8: luminaire 'A1': the name 'A1' is used twice, first at line 3");
  check_one(light_problems(one(lamp) + "[[luminaire]]\nname = \"B\"\ngroup = \"A1\"\n" + lamp),
            "lamps/lights.toml:7:1: luminaire 'B': its group 'A1' is the name of another luminaire\n        "
            "mixes choose by name or group: keep them apart");
}

TEST_CASE("Photometric files that are missing or wrong are named", "[scene][lights][unit]") {
  check_one(light_problems(one("fitting = \"none.ies\"\nat = [1,1,2.5]")),
            "lamps/lights.toml:4:11: luminaire 'A1': lamps/none.ies: No such file or directory");
  check_one(light_problems(one("fitting = \"a.ldt\"\nat = [1,1,2.5]")),
            "lamps/lights.toml:4:11: luminaire 'A1': lamps/a.ldt: No such file or directory");
  const auto bad = light_problems(one("fitting = \"bad.ies\"\nat = [1,1,2.5]"));
  REQUIRE(bad.size() == 1);
  CHECK(bad[0].starts_with("lamps/bad.ies:7:5: "));
}

TEST_CASE("A sky over a zone without windows and empty files are refused", "[scene][lights][unit]") {
  check_one(light_problems(one("fitting = \"a.ies\"\nat = [1,1,2.5]") + "[sky]\nmodel = \"uniform\"\nhorizontal = 10000\n"),
            "lamps/lights.toml:6:1: no light of the sky comes in: the zone is closed and has no window\n"
            "        give a surface of the zone file a finish of kind = \"glazing\"");
  check_one(light_problems("dim = \"lights/1\"\n"),
            "lamps/lights.toml:1:1: the file has no light source\n        write at least one [[luminaire]], or a [sky]");
  check_one(light_problems("dim = \"zone/1\"\n"),
            "lamps/lights.toml:1:7: 'zone/1' is not a lights file\n        a lights file begins with dim = "
            "\"lights/1\"");
}
