#include <cmath>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "database/entry_name.hpp"
#include "database/entry_store.hpp"
#include "database/entry_text.hpp"
#include "database/finish_figures.hpp"
#include "database/fitting_record.hpp"
#include "database/search.hpp"
#include "database/spectrum_csv.hpp"
#include "database/surface_entry.hpp"
#include "image/drawing.hpp"

namespace {

namespace fs = std::filesystem;

dim::SpectrumTable read(const std::string& text) { return dim::read_spectrum_csv(text, "s.csv"); }

void refused(const std::string& text, int line, const std::string& says) {
  INFO(text);
  try {
    read(text);
    FAIL_CHECK("it was read");
  } catch (const dim::InputError& error) {
    CHECK(error.problems().front().place.line == line);
    CHECK_THAT(error.problems().front().what, Catch::Matchers::Contains(says));
  }
}

struct NoText : dim::TextDrawer {
  bool available() const override { return false; }
  dim::TextExtent measure(const std::string&, int) const override { return {}; }
  void draw(dim::Picture8&, int, int, const std::string&, int, dim::Rgb8) const override {}
};

}  // namespace

TEST_CASE("Spectra in nm or um, fractions or per cent, in either order, are the same", "[database][unit]") {
  for (const char* text :
       {"nm,reflectance\n400,0.1\n500,0.2\n", "400 0.1\n500 0.2\n", "wavelength;R\n400;0,1\n500;0,2\n",
        "0.4,0.1\n0.5,0.2\n", "nm,%\n400,10\n500,20\n", "400\t10\n500\t20\n",
        "# made\r\n500,0.2\r\n400,0.1\r\n", "\xC2\xB5m,percent\n0.4,10\n0.5,20\n",
        "\"nm\",\"R\"\n\"400\",\"0.1\"\n\"500\",\"0.2\"\n"}) {
    INFO(text);
    const auto table = read(text);
    REQUIRE(table.curves.size() == 1);
    CHECK(table.curves[0].at(400) == Approx(0.1));
    CHECK(table.curves[0].at(450) == Approx(0.15));
    CHECK(table.curves[0].at(500) == Approx(0.2));
  }
  const auto two = read("nm,T,R\n400,0.8,0.1\n700,0.9,0.05\n");
  CHECK(two.names == std::vector<std::string>{"T", "R"});
  CHECK(two.curves[1].at(700) == Approx(0.05));
}

TEST_CASE("Spectra that cannot be are refused with their line", "[database][unit]") {
  refused("", 1, "0 wavelengths");
  refused("nm,R\n400,0.1\n", 3, "1 wavelengths");
  refused("400,0.1\n500,abc\n", 2, "'abc' is not a finite number");
  refused("400,0.1\n500,nan\n", 2, "'nan' is not a finite number");
  refused("400,0.1\n400,0.2\n", 2, "not in order");
  refused("400,0.1\n500,0.2\n450,0.3\n", 3, "not in order");
  refused("400,-0.1\n500,0.2\n", 1, "value -0.1 is outside 0..1");
  refused("400,10\n500,120\n", 2, "value 120 is outside 0..100");
  refused("400,0.9\n500,1.2\n", 2, "largest value 1.2");
  refused("400,0.1\n500,0.2,0.3\n", 2, "3 columns where line 1 has 2");
  refused("2000,0.1\n2500,0.2\n", 0, "not visible");
}

TEST_CASE("Entry names are safe file names", "[database][unit]") {
  for (const char* good : {"troffer-3600", "a", "B_1+2.5", "Büro"}) CHECK(dim::is_entry_name(good));
  for (const char* bad : {"", "-x", ".x", "a/b", "a b", "a\\b", "a\nb", "..", "a*"})
    CHECK_FALSE(dim::is_entry_name(bad));
  CHECK_FALSE(dim::is_entry_name(std::string(101, 'a')));
  CHECK(dim::entry_name_from("My Lamp (v2)") == "My-Lamp-v2");
  CHECK(dim::entry_name_from("../..") == "");
  CHECK(dim::entry_name_from("--x") == "x");
  CHECK(dim::is_entry_name(dim::entry_name_from(std::string(99, 'a') + "\xC3\xA4" + "b")));
}

TEST_CASE("A name that is taken is not replaced unasked, and then nothing is written", "[database][unit]") {
  const auto folder = fs::temp_directory_path() / "dim-entry-store-test";
  fs::remove_all(folder);
  dim::EntryStore store((folder / "fittings").string());
  CHECK_FALSE(store.add({{"a.ies", "1"}, {"a.toml", "2"}}, false));
  CHECK(store.add({{"b.ies", "1"}, {"a.toml", "3"}}, false) == "a.toml");
  CHECK_FALSE(fs::exists(folder / "fittings/b.ies"));
  CHECK_FALSE(store.add({{"a.ies", "4"}, {"a.toml", "5"}}, true));
  std::ifstream in(folder / "fittings/a.toml");
  CHECK(std::string(std::istreambuf_iterator<char>(in), {}) == "5");
  store.remove({"a.ies", "a.toml", "none"});
  CHECK(fs::is_empty(folder / "fittings"));
  fs::remove_all(folder);
}

TEST_CASE("What is written of an entry is read back", "[database][unit]") {
  dim::FittingEntry entry;
  entry.title = "A \"quoted\" \\ title\nof two lines";
  entry.file = "x.ies";
  entry.watts = 33.5;
  entry.lumens = 1234.5678;
  entry.lamp_factor = 0.95;
  entry.maintenance_factor = 0.8;
  entry.spectrum_name = "d65";
  entry.source = "somewhere";
  const auto same = dim::read_fitting_entry(dim::fitting_entry_text(entry), "folder/e.toml", "e");
  CHECK(same.title == entry.title);
  CHECK(same.file == "folder/x.ies");
  CHECK(same.watts == entry.watts);
  CHECK(same.lumens == entry.lumens);
  CHECK(same.lamp_factor == 0.95);
  CHECK(same.maintenance_factor == 0.8);
  CHECK(same.spectrum_name == "d65");
  dim::SurfaceDraft draft;
  draft.title = draft.source = "t";
  draft.diffuse = dim::SpectralCurve({{400, 0.125}, {500, 1.0 / 3}, {600, 0.5}});
  const auto finish = dim::read_surface_entry(dim::surface_entry_text(draft), "s.toml", "s");
  CHECK(finish.diffuse.at(500) == Approx(1.0 / 3).epsilon(1e-9));
  CHECK(finish.diffuse.at(400) == 0.125);
}

TEST_CASE("Figures of a finish: diffuse and Fresnel's reflectance at normal incidence", "[database][unit]") {
  dim::Finish finish;
  finish.diffuse = dim::SpectralCurve(0.3);
  CHECK(dim::finish_xyz(finish, dim::SpectralCurve(1.0)).y == Approx(0.3));
  finish.specular = 0.5;
  finish.ior = dim::SpectralCurve(1.5);
  CHECK(dim::reflectance_at(finish, 555) == Approx(0.5 * 0.3 + 0.5 * 0.04));
  finish.specular_reflectance = dim::SpectralCurve(0.9);
  CHECK(dim::reflectance_at(finish, 555) == Approx(0.5 * 0.3 + 0.5 * 0.9));
  finish.kind = dim::FinishKind::glazing;
  finish.transmittance = dim::SpectralCurve(0.8);
  CHECK(dim::finish_xyz(finish, dim::SpectralCurve(1.0)).y == Approx(0.8));
}

TEST_CASE("Every shipped fitting says what it is, and emits what it declares to 0.1 %",
          "[database][validation]") {
  const std::string db = std::string(DIM_SOURCE_DIR) + "/db";
  const dim::DatabaseSearch search{{db}};
  std::size_t n = 0;
  for (const auto& name : search.names("fittings")) {
    INFO(name);
    dim::Warnings warnings;
    const auto record = dim::read_fitting_record(*search.find_fitting(name), name, warnings);
    CHECK(warnings.empty());
    REQUIRE(record.photometry.declared_flux_lm);
    CHECK(record.photometry.flux_lm == Approx(*record.photometry.declared_flux_lm).epsilon(1e-3));
    CHECK(record.entry.watts.value_or(0) == record.photometry.watts.value_or(-1));
    CHECK(record.entry.spectrum);
    CHECK_THAT(record.entry.source, Catch::Matchers::Contains("not a product"));
    CHECK_FALSE(record.entry.title.empty());
    ++n;
  }
  CHECK(n >= 20);
}

TEST_CASE("A drawing's areas and lines cover the pixels they should", "[image][unit]") {
  dim::Drawing drawing;
  drawing.width = 20;
  drawing.height = 10;
  drawing.title = "a < b & c";
  drawing.areas.push_back({{{2.0, 2.0}, {6.5, 2.0}, {6.5, 8.0}, {2.0, 8.0}}, {0, 0, 0}});
  drawing.lines.push_back({{{10.0, 5.5}, {18.0, 5.5}}, 1.0, {255, 0, 0}, false});
  drawing.texts.push_back({{1, 1}, "x<y", 8, dim::TextAnchor::start, {}});
  const auto picture = dim::rasterised(drawing, NoText());
  const auto at = [&](int x, int y, int c) {
    return static_cast<int>(picture.rgb[static_cast<std::size_t>(3 * (y * 20 + x) + c)]);
  };
  CHECK(at(3, 4, 0) == 0);
  CHECK(at(6, 4, 0) == Approx(127).margin(1));
  CHECK(at(7, 4, 0) == 255);
  CHECK(at(3, 1, 0) == 255);
  CHECK(at(14, 5, 0) == 255);
  CHECK(at(14, 5, 1) == 0);
  CHECK(at(14, 7, 1) == 255);
  const std::string svg = dim::svg_text(drawing);
  CHECK_THAT(svg, Catch::Matchers::Contains("<title>a &lt; b &amp; c</title>"));
  CHECK_THAT(svg, Catch::Matchers::Contains(">x&lt;y</text>"));
  CHECK_THAT(svg, Catch::Matchers::EndsWith("</svg>\n"));
}
