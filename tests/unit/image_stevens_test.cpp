#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "catch.hpp"
#include "image/stevens.hpp"
#include "image/tone.hpp"

using dim::Raster;
using dim::Vec3;

namespace {

// One row, equal-energy grey.
Raster row_of(const std::vector<double>& luminances_cd_m2) {
  Raster raster{static_cast<int>(luminances_cd_m2.size()), 1};
  for (const double luminance : luminances_cd_m2) {
    for (int c = 0; c < 3; ++c) raster.xyz.push_back(static_cast<float>(luminance));
  }
  return raster;
}

double shown_cd_m2(const dim::StevensResult& result, std::size_t pixel) {
  return static_cast<double>(result.shown.xyz[3 * pixel + 1]);
}

// A room of reflectances 0.7, 0.5 and 0.2 at a uniform illuminance, each seen in a third of the view.
Raster room(double illuminance_lx) {
  std::vector<double> luminances;
  for (const double reflectance : {0.7, 0.5, 0.2}) {
    luminances.push_back(reflectance * illuminance_lx / dim::kPi);
  }
  return row_of(luminances);
}

}  // namespace

TEST_CASE("An eye adapted to what it looks at sees about Stevens' cube root in brils", "[image][unit]") {
  // The bril: the dark-adapted eye sees 1 microlambert as 1 bril, with the exponent 1/3 (Stevens 1961).
  for (const double lamberts : {1e-4, 1e-2, 1.0}) {
    const double luminance = lamberts * dim::kLambert_cd_m2;
    const double bril = dim::brightness_stevens_bril(luminance, dim::stevens_curve(luminance));
    CHECK(bril == Approx(std::cbrt(lamberts / 1e-6)).epsilon(0.06));
  }
}

TEST_CASE("At one lambert the curve has the constants of Tumblin and Rushmeier 1993", "[image][unit]") {
  const dim::BrightnessCurve curve = dim::stevens_curve(3183.0988618379);
  CHECK(curve.alpha == Approx(2.92).epsilon(1e-12));
  CHECK(curve.beta == Approx(2.0208).epsilon(1e-12));
  const dim::BrightnessCurve hundredth = dim::stevens_curve(31.830988618379);
  CHECK(hundredth.alpha == Approx(2.92 - 0.8).epsilon(1e-12));
  CHECK(hundredth.beta == Approx(-0.4 * 4 + 2.584 * 2 + 2.0208).epsilon(1e-12));
}

TEST_CASE("The exponent in cd/m2 agrees with the one its authors published in 1999", "[image][unit]") {
  // Tumblin, Hodgins & Guenter 1999, ACM Trans. Graph. 18(1), 56-94: gamma = 1.855 + 0.4 log10 La, La the
  // mean in cd/m2; the step of 0.84 from the mean to the white is in it.
  for (const double mean_cd_m2 : {0.1, 1.0, 10.0, 100.0}) {
    const double white = mean_cd_m2 * std::pow(10.0, dim::kWhiteOverMean_log10);
    CHECK(dim::stevens_curve(white).alpha == Approx(1.855 + 0.4 * std::log10(mean_cd_m2)).margin(5e-4));
  }
}

TEST_CASE("Far below the data the curve is that of the dark-adapted eye", "[image][unit]") {
  CHECK(dim::stevens_curve(1e-3).alpha == Approx(dim::kDarkAdaptedExponent));
  CHECK(dim::stevens_curve(1e-300).alpha == dim::stevens_curve(1e-3).alpha);
  CHECK(dim::stevens_curve(1e-300).beta == dim::stevens_curve(1e-3).beta);
  CHECK(dim::stevens_curve(2e-3).alpha > dim::kDarkAdaptedExponent);
}

TEST_CASE("With one adaptation for scene and screen the mapping is linear", "[image][unit]") {
  const dim::BrightnessCurve curve = dim::stevens_curve(40);
  for (const double luminance : {1e-6, 0.3, 40.0, 5e3}) {
    CHECK(dim::display_luminance_cd_m2(luminance, curve, curve) == Approx(luminance).epsilon(1e-12));
  }
  const double adaptation = 100 * std::pow(10.0, -dim::kWhiteOverMean_log10);
  const auto result = dim::map_brightness(row_of({adaptation / 8, adaptation, 8 * adaptation}));
  CHECK(result.scene_adaptation_cd_m2 == Approx(result.screen_adaptation_cd_m2).epsilon(1e-6));
  CHECK(shown_cd_m2(result, 0) == Approx(adaptation / 8).epsilon(1e-5));
  CHECK(shown_cd_m2(result, 2) == Approx(adaptation * 8).epsilon(1e-5));
}

TEST_CASE("What is shown looks as bright on the screen as the scene does", "[image][unit]") {
  const auto result = dim::map_brightness(row_of({0.5, 3, 700}), {.screen_white_cd_m2 = 250});
  const auto scene = dim::stevens_curve(result.scene_adaptation_cd_m2);
  const auto screen = dim::stevens_curve(result.screen_adaptation_cd_m2);
  const std::array<double, 3> luminances = {0.5, 3, 700};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(dim::brightness_stevens_bril(shown_cd_m2(result, i), screen) ==
          Approx(dim::brightness_stevens_bril(luminances[i], scene)).epsilon(1e-5));
  }
}

TEST_CASE("Brighter in the scene is brighter on the screen, whatever the adaptations", "[image][unit]") {
  for (const double scene : {1e-9, 1e-3, 0.1, 30.0, 1e5}) {
    for (const double screen : {0.01, 15.0, 300.0}) {
      double last = 0;
      for (double exponent = -8; exponent < 8; exponent += 0.25) {
        const double shown = dim::display_luminance_cd_m2(std::pow(10.0, exponent), dim::stevens_curve(scene),
                                                          dim::stevens_curve(screen));
        REQUIRE(std::isfinite(shown));
        REQUIRE(shown > last);
        last = shown;
      }
    }
  }
}

TEST_CASE("The darker the scene, the darker each part of its picture", "[image][unit]") {
  std::array<double, 3> last = {1e9, 1e9, 1e9};
  for (double illuminance_lx = 3000; illuminance_lx > 1e-6; illuminance_lx /= 3) {
    const auto result = dim::map_brightness(room(illuminance_lx));
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(shown_cd_m2(result, i) > 0);
      REQUIRE(shown_cd_m2(result, i) < last[i]);
      last[i] = shown_cd_m2(result, i);
    }
  }
}

TEST_CASE("Contrast rises with the light, as Stevens and Stevens found", "[image][unit]") {
  double last = 1;
  for (const double illuminance_lx : {0.1, 10.0, 1000.0}) {
    const auto result = dim::map_brightness(room(illuminance_lx));
    const double contrast = shown_cd_m2(result, 0) / shown_cd_m2(result, 2);
    CHECK(contrast > last);
    last = contrast;
  }
}

TEST_CASE("A room at 500 lx fills the range of a usual screen without burning out", "[image][unit]") {
  const auto result = dim::map_brightness(room(500));
  const auto picture =
      dim::tone_linear(result.shown, {.display_white_cd_m2 = 100, .dither = false}).picture.rgb;
  CHECK((picture[0] > 150 && picture[0] < 210));
  CHECK((picture[3] > 120 && picture[3] < 170));
  CHECK((picture[6] > 60 && picture[6] < 120));
}

TEST_CASE("The adaptation is the geometric mean of what is lit", "[image][unit]") {
  const double nan = std::nan("");
  CHECK(*dim::log_mean_luminance_cd_m2(row_of({1, 100})) == Approx(10));
  CHECK(*dim::log_mean_luminance_cd_m2(row_of({1, 0, nan, 100, HUGE_VAL, -3})) == Approx(10));
  CHECK_FALSE(dim::log_mean_luminance_cd_m2(row_of({0, nan})));
  CHECK(dim::map_brightness(row_of({1, 0, 100, 0, 0})).scene_adaptation_cd_m2 == Approx(10));
}

TEST_CASE("Without luminance a pixel is black, never NaN", "[image][unit]") {
  const double nan = std::nan("");
  const auto result = dim::map_brightness(row_of({50, 0, -1, nan, HUGE_VAL}));
  CHECK(shown_cd_m2(result, 0) > 0);
  for (std::size_t i = 3; i < result.shown.xyz.size(); ++i) CHECK(result.shown.xyz[i] == 0.0f);
  for (const double luminance : {0.0, -2.0, nan}) {
    CHECK(dim::display_luminance_cd_m2(luminance, {2, 1}, {3, 1}) == 0.0);
    CHECK(dim::brightness_stevens_bril(luminance, {2, 1}) == 0.0);
  }
  const auto dark = dim::map_brightness(row_of({0, 0}));
  CHECK(dark.scene_adaptation_cd_m2 == dark.screen_adaptation_cd_m2);
  CHECK(dark.shown.xyz == std::vector<float>(6, 0.0f));
}

TEST_CASE("Luminances of 1e-30 and 1e30 cd/m2 give numbers", "[image][unit]") {
  for (const auto& luminances : {std::vector<double>{1e-30, 1e-28}, {1e30, 1e32}, {1e-30, 1e30}}) {
    const auto result = dim::map_brightness(row_of(luminances));
    for (const float v : result.shown.xyz) CHECK((std::isfinite(v) && v >= 0));
  }
}

TEST_CASE("Brightness mapping keeps chromaticities", "[image][unit]") {
  Raster raster{2, 1, {12, 10, 3, 0.2f, 0.5f, 0.1f}};
  const auto shown = dim::map_brightness(raster).shown.xyz;
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(shown[3 * i] / shown[3 * i + 1] == Approx(raster.xyz[3 * i] / raster.xyz[3 * i + 1]));
    CHECK(shown[3 * i + 2] / shown[3 * i + 1] == Approx(raster.xyz[3 * i + 2] / raster.xyz[3 * i + 1]));
  }
}

TEST_CASE("A screen without light is refused", "[image][unit]") {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(dim::map_brightness(row_of({1}), {.screen_white_cd_m2 = bad}), dim::InputError);
  }
}
