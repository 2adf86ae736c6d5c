#include "database/bsdf_file.hpp"

#include "base/error.hpp"
#include "catch.hpp"

using namespace dim;

namespace {

constexpr std::size_t kValues = klems::kPatches * klems::kPatches;

/// A file of LBNL WINDOW with one block of visible data.
std::string bsdf_xml(const std::string& values, const std::string& basis = "LBNL/Klems Full",
                     const std::string& wavelength = "Visible") {
  return "<?xml version=\"1.0\"?>\n<WindowElement xmlns=\"http://windows.lbl.gov\">\n<Optical><Layer>\n"
         "<WavelengthData><Wavelength unit=\"Integral\">" + wavelength + "</Wavelength>\n<WavelengthDataBlock>\n"
         "<WavelengthDataDirection>Transmission Front</WavelengthDataDirection>\n"
         "<ColumnAngleBasis>" + basis + "</ColumnAngleBasis>\n<RowAngleBasis>" + basis + "</RowAngleBasis>\n"
         "<ScatteringData>\n" + values + "</ScatteringData>\n"
         "</WavelengthDataBlock></WavelengthData>\n</Layer></Optical></WindowElement>\n";
}

std::string repeated(const std::string& value, std::size_t n = kValues) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += value + (i % 145 == 144 ? ",\n" : ", ");
  return text;
}

}  // namespace

TEST_CASE("Patches of the Klems basis fill the hemisphere and hold their own directions", "[reflection][klems][unit]") {
  double sum_sr = 0.0;
  for (std::size_t p = 0; p < klems::kPatches; ++p) {
    sum_sr += klems::projected_solid_angle_sr(p);
    for (const double a : {0.01, 0.5, 0.99})
      for (const double b : {0.01, 0.5, 0.99}) CHECK(klems::patch_of(klems::direction(p, a, b)) == p);
  }
  CHECK(sum_sr == Approx(kPi).epsilon(1e-12));
  // Rings from the normal out: 1, 8, 16, 20, 24, 24, 24, 16, 12.
  CHECK(klems::patch_of({0, 0, 1}) == 0);
  CHECK(klems::patch_of({std::sin(radians(10.0)), 0, std::cos(radians(10.0))}) == 1);
  CHECK(klems::patch_of({std::sin(radians(80.0)), 0, std::cos(radians(80.0))}) == 133);
}

TEST_CASE("A BSDF file gives its matrix, rows of outgoing light", "[database][bsdf][unit]") {
  const auto even = read_bsdf(bsdf_xml(repeated("0.127324")), "even.xml");
  CHECK(even->transmittance(0) == Approx(0.4).epsilon(1e-5));
  CHECK(even->transmittance(144) == Approx(0.4).epsilon(1e-5));
  CHECK(even->hemispherical_transmittance() == Approx(0.4).epsilon(1e-5));
  std::string values = "0 0.25 ";
  values += repeated("0", kValues - 2);
  const auto one = read_bsdf(bsdf_xml(values), "one.xml");
  CHECK(one->btdf_per_sr(0, 1) == 0.25);
  CHECK(one->btdf_per_sr(1, 0) == 0.0);
}

TEST_CASE("BSDF files of another kind are refused with file, line and cause", "[database][bsdf][unit]") {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      read_bsdf(text, "shade.xml");
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      return problem.place.file + ":" + std::to_string(problem.place.line) + " " + problem.what;
    }
    return "";
  };
  const std::string even = repeated("0.1");
  CHECK_THAT(refusal(bsdf_xml(even, "LBNL/Klems Half")),
             Catch::Contains("shade.xml:5") && Catch::Contains("'LBNL/Klems Half'"));
  CHECK_THAT(refusal(bsdf_xml(even, "LBNL/Shirley-Chiu")), Catch::Contains("ColumnAngleBasis"));
  CHECK_THAT(refusal(bsdf_xml("-0.001 " + repeated("0.1", kValues - 1))),
             Catch::Contains("shade.xml:9") && Catch::Contains("value 1 "));
  CHECK_THAT(refusal(bsdf_xml(repeated("0.1", 100) + "nan " + repeated("0.1", kValues - 101))),
             Catch::Contains("value 101 "));
  CHECK_THAT(refusal(bsdf_xml(repeated("0.4"))), Catch::Contains("Klems patch 1 is passed by 1.257"));
  CHECK_THAT(refusal(bsdf_xml(repeated("0.1", kValues - 1))), Catch::Contains("21024 scattering data"));
  CHECK_THAT(refusal(bsdf_xml(even, "LBNL/Klems Full", "Solar")), Catch::Contains("no visible 'Transmission Front'"));
  CHECK_THAT(refusal("<gbXML/>"), Catch::Contains("no BSDF"));
  CHECK_THAT(refusal(bsdf_xml(even).substr(0, 400)), Catch::Contains("shade.xml"));
  CHECK(refusal(bsdf_xml(even)).empty());
}
