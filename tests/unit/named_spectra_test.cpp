#include "spectrum/named_spectra.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "catch.hpp"
#include "reference_csv.hpp"
#include "spectrum/bands.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/observer.hpp"
#include "spectrum/rendering.hpp"
#include "spectrum/white.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// As chromaticity_check.csv was made: plain sums every 5 nm.
Vec3 summed_xyz(const SpectralCurve& spd) {
  const Observer& eye = cie_1931_observer();
  Vec3 sum(0.0);
  for (double nm = 380; nm <= 780; nm += 5)
    sum += spd.at(nm) * Vec3(eye.x.at(nm), eye.y.at(nm), eye.z.at(nm));
  return sum;
}

Vec3 integrated_xyz(const SpectralCurve& spd) { return light_responses(spd).xyz; }

// "FL3.1" is fl3-1, "FL1" fl-1, "LED-B1" led-b1.
std::string our_name(std::string theirs) {
  std::transform(theirs.begin(), theirs.end(), theirs.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (theirs == "a") return "cie-a";
  if (theirs.starts_with("fl3.")) return "fl3-" + theirs.substr(4);
  if (theirs.starts_with("fl") || theirs.starts_with("hp"))
    return theirs.substr(0, 2) + "-" + theirs.substr(2);
  return theirs;
}

std::string refusal(const std::string& name) {
  try {
    find_spectrum(name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Every CIE illuminant has its published chromaticity, temperature and Duv", "[spectrum][unit]") {
  const auto table = read_reference(shared_data() / "illuminants/chromaticity_check.csv");
  if (table.rows.empty()) WARN("skipped: chromaticity_check.csv is not there");
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string name = our_name(table.rows[r][0]);
    CAPTURE(name);
    const SpectralCurve spd = find_spectrum(name);
    const Vec3 xyz = summed_xyz(spd);
    CHECK(xy_of(xyz).x == Approx(table.number(r, "x_published")).margin(1.05e-4));
    CHECK(xy_of(xyz).y == Approx(table.number(r, "y_published")).margin(1.05e-4));
    const WhitePoint white = white_point(xyz);
    CHECK(white.cct_K == Approx(table.number(r, "cct_K_computed")).margin(0.6));
    CHECK(white.duv == Approx(table.number(r, "duv_computed")).margin(6e-6));
    CHECK(xy_of(integrated_xyz(spd)).x == Approx(xy_of(xyz).x).margin(2e-5));
    CHECK(xy_of(integrated_xyz(spd)).y == Approx(xy_of(xyz).y).margin(2e-5));
  }
}

TEST_CASE("Black bodies are found at their own temperature, on the locus", "[spectrum][unit]") {
  for (const double t : {1200.0, 1900.0, 2700.0, 4000.0, 6504.0, 12000.0, 40000.0}) {
    CAPTURE(t);
    const WhitePoint white = white_point(summed_xyz(blackbody(t)));
    // The locus is summed to 830 nm, the light to 780.
    CHECK(white.cct_K == Approx(t).epsilon(t < 7000 ? 5e-4 : 1e-2));
    CHECK(std::abs(white.duv) < 3e-5);
  }
  CHECK(blackbody(2700).at(560) == Approx(1.0));
  // Planck's law itself, at two wavelengths.
  const double c2 = 1.4388e-2, t = 3000;
  const auto planck = [&](double nm) { return std::pow(nm, -5) / (std::exp(c2 / (nm * 1e-9 * t)) - 1.0); };
  CHECK(blackbody(t).at(450) / blackbody(t).at(650) == Approx(planck(450) / planck(650)).epsilon(1e-12));
}

TEST_CASE("Colours that are no whites have no temperature", "[spectrum][unit]") {
  CHECK(std::isnan(white_point(Vec3(0.0)).cct_K));
  CHECK(std::isnan(white_point({0.4124, 0.2127, 0.0193}).cct_K));  // sRGB red
  CHECK(std::isnan(white_point({0.3576, 0.7152, 0.1192}).cct_K));  // green
  CHECK(white_point({0.3576, 0.7152, 0.1192}).duv > 0.05);
}

TEST_CASE("The daylight series at 6503.6 K is D65", "[spectrum][unit]") {
  // README of the reference data: without rounding M1 and M2 the largest difference is 0.016 of 100.
  const SpectralCurve ours = cie_daylight(6500 * 1.4388 / 1.438), table = find_spectrum("d65");
  for (double nm = 380; nm <= 780; nm += 5) CHECK(ours.at(nm) == Approx(table.at(nm)).margin(0.017));
  CHECK(white_point(summed_xyz(cie_daylight(5000))).cct_K == Approx(5000).epsilon(2e-3));
  CHECK(white_point(summed_xyz(cie_daylight(15000))).cct_K == Approx(15000).epsilon(1e-2));
}

TEST_CASE("A mixed LED has exactly the temperature asked for and stays near the locus", "[spectrum][unit]") {
  const auto range = led_white_range();
  CHECK(range.low_K == Approx(2733).margin(3));
  CHECK(range.high_K == Approx(6598).margin(2));
  for (const double t : {2740.0, 3000.0, 3500.0, 4000.0, 4104.0, 5000.0, 6500.0}) {
    CAPTURE(t);
    const WhitePoint white = white_point(integrated_xyz(led_white(t)));
    CHECK(white.cct_K == Approx(t).margin(0.05));
    CHECK(std::abs(white.duv) < 2e-3);
  }
  const SpectralCurve named = find_spectrum("led-4000"), made = led_white(4000);
  CHECK(named.points() == made.points());
}

TEST_CASE("Unknown spectra and temperatures out of range are refused with a cure", "[spectrum][unit]") {
  CHECK(refusal("led-b9").find("no spectrum is called 'led-b9'") != std::string::npos);
  CHECK(refusal("D65").find("did you mean 'd65'") != std::string::npos);
  CHECK(refusal("fl_12").find("did you mean 'fl-12'") != std::string::npos);
  CHECK(refusal("led-9000").find("9000 K is outside 2733 to 6597") != std::string::npos);
  CHECK(refusal("blackbody-500").find("outside 1000 to 100000 K") != std::string::npos);
  CHECK(refusal("daylight-3000").find("outside 4000 to 25000 K") != std::string::npos);
  CHECK_FALSE(refusal("").empty());
  CHECK_FALSE(refusal("led-").empty());
  CHECK_FALSE(refusal("led-nan").empty());
  CHECK_FALSE(refusal("led--4000").empty());
  for (const auto& name : spectrum_names()) {
    CAPTURE(name);
    CHECK(refusal(name).empty());
  }
}

TEST_CASE("Ra and R1..R9 are those of an independent program", "[spectrum][unit]") {
  // colour-science 0.3, tests of colour_rendering_index: FL1, FL2 and A.
  const auto ra = [](const char* name) { return colour_rendering(light_responses(find_spectrum(name))); };
  const auto fl1 = ra("fl-1");
  const double expected[] = {69.1970, 83.6508, 92.1361, 72.6656, 73.8907,
                             79.6192, 82.2726, 53.3906, -47.2845};
  for (std::size_t i = 0; i < 9; ++i) CHECK(fl1.r[i] == Approx(expected[i]).margin(i == 8 ? 1.0 : 0.4));
  CHECK(fl1.ra == Approx(75.8528).margin(0.3));
  CHECK(ra("fl-2").ra == Approx(64.2337).margin(0.3));
  CHECK(ra("cie-a").ra == Approx(99.9962).margin(0.01));
  // CIE 15 states these for its fluorescent lamps, in whole numbers.
  const std::pair<const char*, double> published[] = {
      {"fl-3", 57}, {"fl-4", 51},  {"fl-5", 72},  {"fl-6", 59},  {"fl-7", 90}, {"fl-8", 95},
      {"fl-9", 90}, {"fl-10", 81}, {"fl-11", 83}, {"fl-12", 83}, {"d65", 100}, {"d50", 100}};
  for (const auto& [name, value] : published) {
    CAPTURE(name);
    CHECK(ra(name).ra == Approx(value).margin(0.9));
  }
  CHECK(std::isnan(colour_rendering(LightResponses{}).ra));
}

TEST_CASE("Melanopic equivalent daylight: D65 is its own, A about half", "[spectrum][unit]") {
  // CIE S 026: 1.3262 mW/lm for D65.
  CHECK(melanopic_efficacy_of_daylight_W_lm() == Approx(1.3262e-3).epsilon(1.5e-4));
  const auto ratio = [](const char* name) {
    const auto light = light_responses(find_spectrum(name));
    return melanopic_edi_lx(light.melanopic) / (kMaxEfficacy_lm_W * light.xyz.y);
  };
  CHECK(ratio("d65") == Approx(1.0).epsilon(1e-12));
  // Melanopic daylight efficacy ratios that CIE S 026 gives for A and E, to three digits.
  CHECK(ratio("cie-a") == Approx(0.496).margin(0.002));
  CHECK(ratio("e") == Approx(0.906).margin(0.002));
}

TEST_CASE("Responses of a light over parts of the spectrum add up", "[spectrum][property]") {
  const SpectralCurve spd = find_spectrum("fl-11");
  const auto whole = light_responses(spd);
  LightResponses sum;
  for (const auto& [low, high] : {std::pair{380.0, 443.0}, {443.0, 600.0}, {600.0, 780.0}})
    sum.add(light_responses(spd, low, high), 1.0);
  CHECK(sum.xyz.x == Approx(whole.xyz.x).epsilon(1e-12));
  CHECK(sum.melanopic == Approx(whole.melanopic).epsilon(1e-12));
  CHECK(sum.samples[7].z == Approx(whole.samples[7].z).epsilon(1e-12));
}
