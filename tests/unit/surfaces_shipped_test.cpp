// The surfaces database that comes with the programs.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "database/surface_entry.hpp"
#include "reference_csv.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/lattice.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/observer.hpp"
#include "spectrum/rendering.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kFolder = std::string(DIM_SOURCE_DIR) + "/db";

DatabaseSearch shipped() { return {{kFolder}}; }

Vec3 xyz_under(const SpectralCurve& light, const SpectralCurve& reflectance) {
  const LatticeValues power = on_lattice(light), share = on_lattice(reflectance);
  LatticeValues product;
  for (std::size_t i = 0; i < kTableSize; ++i) product[i] = power[i] * share[i];
  return light_responses(curve_of(product)).xyz / light_responses(light).xyz.y;
}

double luminous(const SpectralCurve& curve) { return xyz_under(find_spectrum("d65"), curve).y; }

std::string text_of(const std::string& name) {
  std::ifstream in(kFolder + "/surfaces/" + name + ".toml");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("Every shipped surface is read, names its source and licence, and gives no more than it gets",
          "[database][unit]") {
  const auto names = shipped().names("surfaces");
  CHECK(names.size() >= 60);
  for (const auto& name : names) {
    CAPTURE(name);
    const Finish finish = find_surface_entry(shipped(), name);
    CHECK(finish.diffuse.max() < 1.0);
    CHECK(finish.diffuse.min() >= 0.0);
    const std::string text = text_of(name);
    for (const char* key : {"\nsource = \"", "\nlicence = \"", "\ntitle = \""})
      CHECK(text.find(key) != std::string::npos);
    const auto source = text.substr(text.find("\nsource = \"") + 11);
    const bool known = source.starts_with("measured") || source.starts_with("computed") ||
                       source.starts_with("estimated") || source.starts_with("by definition") ||
                       source.starts_with("refractive index");
    CHECK(known);
  }
}

TEST_CASE("Shipped glass transmits what was published for it", "[database][unit]") {
  const auto glass = [](const char* name) { return find_surface_entry(shipped(), name); };
  // NFRC: visible transmittance 0.899 and 0.884, reflectance 0.083 and 0.080.
  CHECK(luminous(glass("glazing-clear-3mm").transmittance) == Approx(0.899).margin(1e-3));
  CHECK(luminous(glass("glazing-clear-6mm").transmittance) == Approx(0.884).margin(1e-3));
  CHECK(luminous(glass("glazing-clear-3mm").diffuse) == Approx(0.083).margin(1e-3));
  CHECK(luminous(glass("glazing-clear-6mm").diffuse) == Approx(0.080).margin(1e-3));
  // Two panes at one wavelength: T^2/(1 - R^2) of 0.8946 and 0.0818 where the 6 mm pane has them.
  const Finish one = glass("glazing-clear-6mm"), two = glass("glazing-double-clear-6mm");
  const double t = one.transmittance.at(550), r = one.diffuse.at(550);
  CHECK(two.transmittance.at(550) == Approx(t * t / (1 - r * r)).epsilon(2e-3));
  CHECK(two.diffuse.at(550) == Approx(r + t * t * r / (1 - r * r)).epsilon(1e-2));
  for (const char* name :
       {"glazing-double-low-e", "glazing-grey-6mm", "glazing-bronze-6mm", "glazing-green-6mm"})
    CHECK(text_of(name).find("source = \"estimated") != std::string::npos);
}

TEST_CASE("Shipped metals reflect at normal incidence what is published", "[database][unit]") {
  // n, k of refractiveindex.info at 550 nm: Al 0.915, Ag 0.983, Au 0.792, Cu 0.624, Cr 0.555.
  const std::pair<const char*, double> metals[] = {
      {"aluminium", 0.915}, {"silver", 0.983}, {"gold", 0.792}, {"copper", 0.624}, {"chromium", 0.555}};
  for (const auto& [metal, reflectance] : metals) {
    CAPTURE(metal);
    const Finish finish = find_surface_entry(shipped(), "metal-" + std::string(metal) + "-polished");
    const double n = finish.ior.at(550), k = finish.extinction->at(550);
    CHECK(((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k) == Approx(reflectance).margin(1e-3));
    CHECK(finish.specular == 1.0);
  }
}

TEST_CASE("Shipped ColorChecker patches have the published colours", "[database][unit]") {
  const auto table = read_reference(shared_data() / "reflectance/colorchecker24_published_values.csv");
  if (table.rows.empty()) {
    WARN("skipped: colorchecker24_published_values.csv is not there");
    return;
  }
  const SpectralCurve d50 = find_spectrum("d50");
  const Vec3 white = xyz_under(d50, SpectralCurve(1.0));
  double mean = 0.0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string start = "colorchecker-" + std::string(r < 9 ? "0" : "") + std::to_string(r + 1) + "-";
    std::string name;
    for (const auto& one : shipped().names("surfaces"))
      if (one.starts_with(start)) name = one;
    CAPTURE(name);
    const Lab lab = lab_of(xyz_under(d50, find_surface_entry(shipped(), name).diffuse), white);
    const Lab published{table.number(r, "xrite_pre2014_L_D50"), table.number(r, "xrite_pre2014_a_D50"),
                        table.number(r, "xrite_pre2014_b_D50")};
    // One chart against the maker's mean of many.
    CHECK(delta_e_2000(lab, published) < 4.0);
    mean += delta_e_2000(lab, published) / 24.0;
  }
  CHECK(mean < 1.5);
}
