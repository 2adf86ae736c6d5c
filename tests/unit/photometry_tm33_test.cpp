#include "catch.hpp"
#include "photometry/photometry_file.hpp"
#include "photometry/tm33.hpp"

namespace {

using dim::kPi;

dim::Photometry read(const std::string& name, dim::Warnings& warnings) {
  return dim::read_photometric_file(std::string(DIM_SOURCE_DIR) + "/tests/data/photometry/" + name, warnings);
}

// A file of emitters; each is what stands between its tags.
std::string file_of(std::initializer_list<std::string> emitters) {
  std::string text = "<IESTM33>\n<Header/>\n";
  for (const auto& emitter : emitters) text += "<Emitter>\n" + emitter + "\n</Emitter>\n";
  return text + "</IESTM33>\n";
}

// A rotationally symmetric emitter of the same intensity below the horizon.
std::string even_emitter(const std::string& cd, const std::string& more = "") {
  return "<LuminousData><LuminousIntensity>\n<IntData h='0' v='0'>" + cd +
         "</IntData><IntData h='0' v='90'>" + cd + "</IntData></LuminousIntensity></LuminousData>" + more;
}

std::string spectrum(const std::string& values) {
  return "<SpectralDistribution><Wavelengths>400 500 600 700</Wavelengths><Values>" + values +
         "</Values></SpectralDistribution>";
}

dim::Photometry read_text(const std::string& text, dim::Warnings& warnings) {
  return dim::read_photometry(text, "t.xml", warnings);
}

dim::Problem refusal(const std::string& text) {
  dim::Warnings warnings;
  try {
    read_text(text, warnings);
  } catch (const dim::InputError& error) {
    return error.problems().front();
  }
  return {};
}

}  // namespace

TEST_CASE("TM-33-18: intensity, opening, watts, colour and spectrum of a file", "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const auto p = read("tm33_18.xml", warnings);
  CHECK(warnings.empty());
  CHECK(p.format == "TM-33-18");
  CHECK(p.symmetry == dim::Symmetry::kQuadrilateral);
  // Linear in C between 100 and 150 cd: on average 125 cd over the hemisphere.
  CHECK(p.flux_lm == Approx(250.0 * kPi).epsilon(1e-12));
  CHECK(dim::IntensityTable(p.distribution).at_c_gamma(dim::radians(210), dim::radians(60)) ==
        Approx(100.0 + 50.0 / 3.0));
  // Two areas of 0.5 m with 0.2 m between them: 1.2 m along C90-C270.
  CHECK(p.opening.shape == dim::OpeningShape::kRectangle);
  CHECK(p.opening.width_m == Approx(1.2));
  CHECK(p.opening.length_m == Approx(0.3));
  CHECK(p.watts == 9.5);
  CHECK(p.lamp_sets.front().colour == "4000 K");
  CHECK(p.lamp_sets.front().rendering == "Ra 82");
  CHECK(p.declared_flux_lm == 785.4);
  CHECK_FALSE(p.lumens_per_lamp.has_value());
  CHECK(p.keyword("MANUFAC") == "Wörk & Söhne");
  REQUIRE(p.spectrum.has_value());
  CHECK(p.spectrum->at(550.0) == Approx(2.5));
  CHECK(p.spectrum->at(390.0) == 0.0);
}

TEST_CASE("TM-33-23: multiplier, ballast factor of relative photometry, values in any order",
          "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const auto p = read("tm33_23.xml", warnings);
  CHECK(p.format == "TM-33-23");
  CHECK(p.flux_lm == Approx(2.0 * kPi * 50.0 * 2.0 * 0.9));
  CHECK(p.n_lamps == 2);
  CHECK(p.declared_lamp_flux_lm == 800.0);
  CHECK(p.opening.shape == dim::OpeningShape::kEllipse);
  CHECK(p.opening.length_m == 0.2);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what.find("no emission areas") != std::string::npos);
}

TEST_CASE("TM-33: emitters add up, their spectra by flux", "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const std::string watts = "<InputWatts>10</InputWatts>";
  const auto p = read_text(file_of({even_emitter("100", watts + spectrum("1 1 1 1")),
                                    even_emitter("50", watts + spectrum("2 2 2 2"))}),
                           warnings);
  CHECK(p.flux_lm == Approx(300.0 * kPi));
  CHECK(p.watts == 20.0);
  CHECK(p.symmetry == dim::Symmetry::kAxial);
  // Both are flat: so is their mixture, whatever each is scaled to.
  REQUIRE(p.spectrum.has_value());
  CHECK(p.spectrum->at(450.0) / p.spectrum->at(650.0) == Approx(1.0));
  const auto unknown =
      read_text(file_of({even_emitter("100", spectrum("1 1 1 1")), even_emitter("50")}), warnings);
  CHECK_FALSE(unknown.spectrum.has_value());
}

TEST_CASE("TM-33: of two emitters of one flux each gives half the light of the mixture",
          "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const auto p = read_text(
      file_of({even_emitter("80", spectrum("1 0 0 0")), even_emitter("80", spectrum("0 0 0 5"))}), warnings);
  const auto first = read_text(file_of({even_emitter("80", spectrum("1 0 0 0"))}), warnings);
  const auto second = read_text(file_of({even_emitter("80", spectrum("0 0 0 5"))}), warnings);
  // Luminous integrals of the two parts, from the curves themselves: 400..500 nm and 600..700 nm do not
  // overlap.
  REQUIRE(p.spectrum.has_value());
  const double blue = p.spectrum->at(420.0) / first.spectrum->at(420.0);
  const double red = p.spectrum->at(680.0) / second.spectrum->at(680.0);
  CHECK(blue > red);  // the eye sees less of it, so that it takes more power
}

TEST_CASE("TM-33: what cannot be read is refused with its line", "[photometry][tm33][unit]") {
  struct Case {
    std::string text;
    int line;
    const char* says;
  };
  const std::string grid = "<LuminousData><LuminousIntensity>\n";
  const std::string end = "</LuminousIntensity></LuminousData>";
  const Case cases[] = {
      {"<IESTM33><Header></IESTM33>", 1, "not well-formed"},
      {"<gbXML></gbXML>", 1, "XML, but not TM-33: its outermost element is 'gbXML'"},
      {"<IESTM33/>", 1, "no Emitter"},
      {file_of({"<PhotonData/>"}), 3, "radiant or photon intensities alone"},
      {file_of({""}), 3, "no luminous intensities"},
      {file_of({grid + "<IntData h='0' v='0'>1</IntData>" + end}), 4, "a single vertical angle"},
      {file_of({grid + "<IntData h='0' v='0'>1</IntData>\n<IntData h='0' v='90'>x</IntData>" + end}), 6,
       "intensity: 'x' is not a finite number"},
      {file_of({grid + "<IntData h='0' v='0'>1</IntData>\n<IntData h='0' v='90'>-1</IntData>" + end}), 6,
       "intensity -1 is outside 0.."},
      {file_of({grid +
                "<IntData h='0' v='0'>1</IntData><IntData h='0' v='90'>1</IntData><IntData h='90' v='0'>1"
                "</IntData>" +
                end}),
       4, "no intensity at h 90 v 90"},
      {file_of({grid +
                "<IntData h='0' v='0'>1</IntData><IntData h='0' v='0'>1</IntData><IntData h='0' v='90'>1"
                "</IntData>" +
                end}),
       5, "is given twice"},
      {"<IESTM33><Equipment><Gonioradiometer><Type>CIE_B</Type></Gonioradiometer></Equipment>\n<Emitter>" +
           even_emitter("1") + "</Emitter></IESTM33>",
       2, "photometric type 'CIE_B'"},
  };
  for (const auto& expected : cases) {
    INFO(expected.text);
    const auto problem = refusal(expected.text);
    CHECK(problem.place.line == expected.line);
    CHECK(problem.what.find(expected.says) != std::string::npos);
  }
}

TEST_CASE("TM-33: sizes in millimetres and an unusable spectrum are warned of", "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const auto p = read_text(
      "<IESTM33><Luminaire><Dimensions><Length>600</Length><Width>300</Width></Dimensions>"
      "</Luminaire><Emitter>" +
          even_emitter("1", spectrum("0 0 0 0")) + "</Emitter></IESTM33>",
      warnings);
  CHECK(p.opening.width_m == Approx(0.6));
  CHECK_FALSE(p.spectrum.has_value());
  std::string all;
  for (const auto& warning : warnings) all += warning.what + "\n";
  CHECK(all.find("read as millimetres") != std::string::npos);
  CHECK(all.find("spectrum not used") != std::string::npos);
}

TEST_CASE("An external entity in XML is not followed", "[photometry][tm33][unit]") {
  dim::Warnings warnings;
  const auto p = read_text(
      "<!DOCTYPE IESTM33 [<!ENTITY e SYSTEM \"file:///etc/passwd\">]>\n<IESTM33><Header>"
      "<Manufacturer>&e;</Manufacturer></Header><Emitter>" +
          even_emitter("1") + "</Emitter></IESTM33>",
      warnings);
  CHECK(p.keyword("MANUFAC").find("root") == std::string::npos);
}
