#include <filesystem>
#include <fstream>
#include <random>

#include "catch.hpp"
#include "database/fitting_entry.hpp"
#include "database/search.hpp"
#include "database/surface_entry.hpp"
#include "spectrum/named_spectra.hpp"

using namespace dim;

namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, gone afterwards.
struct Folder {
  fs::path path;
  Folder() : path(fs::temp_directory_path() / ("dim-test-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
  }
};

std::string message_of(const std::string& text) {
  try {
    read_surface_entry(text, "oak.toml", "oak");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("An opaque entry becomes a finish", "[database][unit]") {
  const Finish finish = read_surface_entry(
      "dim = \"surface/1\"\nkind = \"opaque\"\ndiffuse = [[400, 0.2], [700, 0.4]]\nspecular = 0.1\n"
      "roughness = 0.2\nior = 1.4\nsource = \"estimated\"\n",
      "oak.toml", "oak");
  CHECK(finish.name == "oak");
  CHECK(finish.source == "oak");
  CHECK(finish.diffuse.at(550) == Approx(0.3));
  CHECK(finish.specular == 0.1);
  CHECK(finish.roughness == 0.2);
  CHECK(finish.ior.at(555) == 1.4);
  CHECK_FALSE(finish.is_diffuse());
}

TEST_CASE("A glazing entry keeps transmittance and reflectance", "[database][unit]") {
  const Finish finish =
      read_surface_entry("kind = \"glazing\"\ntransmittance = 0.88\nreflectance = 0.08\n", "g.toml", "clear");
  CHECK(finish.kind == FinishKind::glazing);
  CHECK(finish.transmittance.at(500) == 0.88);
  CHECK(finish.diffuse.at(500) == 0.08);
  CHECK_FALSE(finish.is_diffuse());
}

TEST_CASE("Surface entries that cannot be are refused", "[database][unit]") {
  CHECK(message_of("diffuse = 1.5\n") ==
        "oak.toml:1:11: diffuse must be at least 0 and less than 1, not 1.5");
  CHECK(message_of("kind = \"opaque\"\n") == "oak.toml:1:1: 'diffuse' is missing");
  CHECK(message_of("kind = \"metal\"\n")
            .find("oak.toml:1:8: kind must be one of opaque, glazing, not 'metal'") != std::string::npos);
  CHECK(message_of("dim = \"surface/2\"\ndiffuse = 0.5\n").find("newer") != std::string::npos);
  CHECK(message_of("dim = \"fitting/1\"\ndiffuse = 0.5\n").find("not a surface file") != std::string::npos);
  CHECK(message_of("diffuse = 0.5\nrougness = 0.2\n") ==
        "oak.toml:2:1: unknown key 'rougness'\n        did you mean 'roughness'?");
  CHECK(
      message_of("transmittance = 0.9\nreflectance = [[400, 0.05], [700, 0.2]]\n") ==
      "oak.toml:1:17: transmittance and reflectance add up to 1.1 at 700 nm\n        their sum is at most 1");
  CHECK(message_of("diffuse = []\n").starts_with("oak.toml:1:11: diffuse is empty"));
}

TEST_CASE("Spectra that cannot be are refused with value, range and cure", "[database][unit]") {
  const auto starts = [](const std::string& text, const std::string& wanted) {
    const std::string message = message_of(text);
    CAPTURE(message, wanted);
    CHECK(message.starts_with(wanted));
  };
  const std::string at = "oak.toml:1:";
  starts("diffuse = [[380, 0.2], [550, 14], [780, 0.3]]\n",
         at + "30: diffuse must be at least 0 and less than 1, not 14 at 550 nm\n        in percent? write "
              "0.14");
  starts("diffuse = [[380, 0.2], [780, -0.1]]\n",
         at + "30: diffuse must be at least 0 and less than 1, not -0.1 at 780 nm");
  starts("diffuse = 84\n",
         at + "11: diffuse must be at least 0 and less than 1, not 84\n        in percent? write 0.84");
  starts(
      "diffuse = [[380, 20], [780, 30]]\n",
      at + "18: diffuse must be at least 0 and less than 1, not 20 at 380 nm\n        in percent? write 0.2");
  starts(
      "diffuse = [[0.38, 0.2], [0.78, 0.3]]\n",
      at + "12: diffuse: wavelengths run from 0.38 to 0.78 nm, which no eye sees\n        in micrometres?");
  starts("diffuse = [[3800, 0.2], [7800, 0.3]]\n",
         at + "12: diffuse: wavelengths run from 3800 to 7800 nm, which no eye sees\n        in angstroms?");
  starts("diffuse = [[900, 0.2], [2500, 0.3]]\n",
         at + "12: diffuse: wavelengths run from 900 to 2500 nm, outside the visible range of 380 to 780 nm");
  starts("diffuse = [[-380, 0.2], [780, 0.3]]\n", at + "12: diffuse: wavelengths must be greater than 0 nm");
  starts("diffuse = [[500, 0.2], [480, 0.3]]\n",
         at + "24: diffuse: wavelengths must ascend, 480 nm follows 500 nm");
  starts("diffuse = [[500, 0.2], [500, 0.3]]\n",
         at + "24: diffuse: wavelengths must ascend, 500 nm follows 500 nm");
  starts("diffuse = [[500, 0.2]]\n",
         at + "12: diffuse: a single point is no spectrum\n        write 0.2 alone");
  starts("diffuse = [[400, 0.2], [500, nan]]\n", at + "30: diffuse must be finite, not nan");
  starts("diffuse = [[400, 0.2, 1], [500, 0.3]]\n", at + "12: diffuse must be 2 numbers, not 3");
  starts("diffuse = [0.2, 0.3]\n", at + "12: diffuse must be 2 numbers, not a number");
  // 10 nm apart but for 490..590 nm.
  starts(
      "diffuse = "
      "[[450,0.1],[460,0.1],[470,0.1],[480,0.1],[490,0.1],[590,0.4],[600,0.4],[610,0.4],[620,0.4]]\n",
      at + "52: diffuse: no value between 490 and 590 nm, where the points are otherwise 10 nm apart");
}

TEST_CASE("Sparse and line spectra have no gaps", "[database][unit]") {
  // A step filter: as many points as it needs.
  CHECK(message_of("diffuse = [[380,0.1],[500,0.1],[520,0.6],[780,0.7]]\n").empty());
  // Three lines: dark between them, close points within.
  CHECK(message_of(
            "diffuse = [[434,0],[436,0.5],[438,0],[544,0],[546,0.5],[548,0],[610,0],[612,0.5],[614,0]]\n")
            .empty());
}

TEST_CASE("Shine out of range is refused with value and range", "[database][unit]") {
  const std::string base = "diffuse = 0.3\n";
  CHECK(message_of(base + "specular = 1.2\n") == "oak.toml:2:12: specular must be 0 to 1, not 1.2");
  CHECK(message_of(base + "specular = -0.1\n") == "oak.toml:2:12: specular must be 0 to 1, not -0.1");
  CHECK(message_of(base + "roughness = -0.1\n") == "oak.toml:2:13: roughness must be 0 to 10, not -0.1");
  CHECK(message_of(base + "ior = 0.9\n") ==
        "oak.toml:2:7: ior must be at least 1 where there is no extinction, not 0.9\n        give the "
        "extinction "
        "of a metal beside its ior");
  CHECK(message_of(base + "ior = 0\n") == "oak.toml:2:7: ior must be greater than 0 and at most 100, not 0");
  CHECK(message_of(base + "extinction = -1\n") == "oak.toml:2:14: extinction must be 0 to 100, not -1");
  // Silver.
  const Finish silver =
      read_surface_entry("diffuse = 0\nspecular = 1\nior = 0.06\nextinction = 3.6\n", "s", "s");
  CHECK(silver.ior.at(550) == 0.06);
}

TEST_CASE("Folders are searched in order, names listed once", "[database][unit]") {
  const Folder folder;
  folder.write("first/surfaces/oak.toml", "diffuse = 0.3\n");
  folder.write("second/surfaces/oak.toml", "diffuse = 0.4\n");
  folder.write("second/surfaces/white paint.toml", "diffuse = 0.8\n");
  folder.write("second/surfaces/notes.txt", "");
  const DatabaseSearch search{
      {(folder.path / "none").string(), (folder.path / "first").string(), (folder.path / "second").string()}};
  CHECK(find_surface_entry(search, "oak").diffuse.at(500) == 0.3);
  CHECK(find_surface_entry(search, "white paint").diffuse.at(500) == 0.8);
  CHECK(search.names("surfaces") == std::vector<std::string>{"oak", "white paint"});
  CHECK_FALSE(search.find_surface("../surfaces/oak"));
  CHECK_FALSE(search.find_surface(""));
  CHECK_FALSE(search.find_fitting("oak"));
  try {
    find_surface_entry(search, "aok");
    FAIL("found");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("no surface 'aok' in ") != std::string::npos);
  }
}

TEST_CASE("A fitting entry names its file beside itself", "[database][unit]") {
  const FittingEntry entry = read_fitting_entry(
      "dim = \"fitting/1\"\ntitle = \"T\"\nfile = \"t.ies\"\nwatts = 33\nlumens = 3500\nspectrum = "
      "\"led-4000\"\n"
      "source = \"made up\"\nlicence = \"CC0-1.0\"\n",
      "db/fittings/t.toml", "t");
  CHECK(entry.file == "db/fittings/t.ies");
  CHECK(entry.watts == 33);
  CHECK(entry.lumens == 3500);
  CHECK(entry.spectrum_name == "led-4000");
  REQUIRE(entry.spectrum.has_value());
  CHECK(entry.spectrum->points() == find_spectrum("led-4000").points());
  CHECK(entry.source == "made up");
  const FittingEntry own =
      read_fitting_entry("file = \"t.ies\"\nspectrum = [[400, 1], [700, 2]]\n", "t.toml", "t");
  REQUIRE(own.spectrum.has_value());
  CHECK(own.spectrum->at(550) == Approx(1.5));
  CHECK_THROWS_AS(read_fitting_entry("watts = 3\n", "t.toml", "t"), InputError);
  CHECK_THROWS_AS(read_fitting_entry("file = \"t.ies\"\nwatts = -3\n", "t.toml", "t"), InputError);
  CHECK_THROWS_AS(read_fitting_entry("file = \"t.ies\"\nspectrum = [[400, 0]]\n", "t.toml", "t"), InputError);
}
