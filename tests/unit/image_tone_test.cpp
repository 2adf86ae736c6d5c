#include <array>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "catch.hpp"
#include "image/linear_rgb.hpp"
#include "image/tone.hpp"

using dim::Raster;
using dim::Vec3;

namespace {

Raster uniform(int width, int height, const Vec3& xyz) {
  Raster raster{width, height, {}, {}, "lx"};
  for (std::size_t i = 0; i < raster.n_pixels(); ++i) {
    for (int c = 0; c < 3; ++c) raster.xyz.push_back(static_cast<float>(xyz[c]));
  }
  return raster;
}

}  // namespace

TEST_CASE("A grey in equal-energy white is shown as R = G = B", "[image][unit]") {
  const auto result = dim::tone_linear(uniform(3, 2, Vec3(50, 50, 50)), {.display_white_cd_m2 = 100});
  // 0.5 linear is 187.5 of 255 by IEC 61966-2-1: one of two steps, by the dither.
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK((result.picture.rgb[3 * i] == 187 || result.picture.rgb[3 * i] == 188));
    CHECK(result.picture.rgb[3 * i] == result.picture.rgb[3 * i + 1]);
    CHECK(result.picture.rgb[3 * i] == result.picture.rgb[3 * i + 2]);
  }
  CHECK(result.n_out_of_gamut == 0);
  CHECK(result.n_above_white == 0);
}

TEST_CASE("Without adaptation equal-energy white looks pink on a D65 display", "[image][unit]") {
  dim::ToneOptions options;
  options.scene_white_xyz = dim::xyz_of(dim::kWhiteD65);
  options.display_white_cd_m2 = 100;
  const auto rgb = dim::tone_linear(uniform(1, 1, Vec3(50, 50, 50)), options).picture.rgb;
  CHECK(rgb[0] > rgb[1]);
  CHECK(rgb[1] > 0);
}

TEST_CASE("The given exposure maps its luminance to full white", "[image][unit]") {
  const auto at_white = dim::tone_linear(uniform(1, 1, Vec3(200, 200, 200)), {.display_white_cd_m2 = 200});
  CHECK(at_white.picture.rgb == std::vector<std::uint8_t>{255, 255, 255});
  CHECK(at_white.n_above_white == 0);
  CHECK(at_white.display_white_cd_m2 == 200);
  const auto above = dim::tone_linear(uniform(2, 1, Vec3(201, 201, 201)), {.display_white_cd_m2 = 200});
  CHECK(above.picture.rgb == std::vector<std::uint8_t>(6, 255));
  CHECK(above.n_above_white == 2);
}

TEST_CASE("The automatic exposure shows the logarithmic mean of what is lit at 0.35", "[image][unit]") {
  // A geometric series 1 ... 2^10 of which the brightest tenth does not count: the mean is that of 2^0 ... 2^9.
  Raster raster = uniform(11, 1, Vec3(0, 0, 0));
  for (std::size_t i = 0; i < 11; ++i) raster.xyz[3 * i + 1] = static_cast<float>(std::exp2(0.1 * static_cast<double>(i)));
  CHECK(dim::automatic_display_white_cd_m2(raster) == Approx(std::exp2(0.45) / 0.35));
}

TEST_CASE("A few bright surfaces in the dark are not washed out", "[image][unit]") {
  Raster raster = uniform(100, 1, Vec3(0.01, 0.01, 0.01));
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t c = 0; c < 3; ++c) raster.xyz[3 * i + c] = 100;
  CHECK(dim::automatic_display_white_cd_m2(raster) == Approx(50.0));
}

TEST_CASE("Highlights roll off: in order, with a continuous slope, none of them white", "[image][unit]") {
  CHECK(dim::rolled_off(0.59) == 0.59);
  const double step = 1e-6;
  CHECK((dim::rolled_off(0.6 + step) - 0.6) / step == Approx(1.0).epsilon(1e-5));
  double before = 0.0;
  for (double x = 0.01; x < 1e6; x *= 1.3) {
    CHECK(dim::rolled_off(x) > before);
    CHECK(dim::rolled_off(x) < 1.0);
    before = dim::rolled_off(x);
  }
  // Two coloured lights a thousand times brighter than the rest differ still, and keep their order of channels.
  Raster raster = uniform(100, 1, Vec3(50, 50, 50));
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      raster.xyz[3 * i + c] = std::array{5.2F, 5.0F, 3.5F}[c] * (i == 0 ? 20.0F : 40.0F);
  const auto result = dim::tone_linear(raster, {.dither = false});
  const auto& rgb = result.picture.rgb;
  CHECK(rgb[0] >= rgb[1]);
  CHECK(rgb[1] > rgb[2]);
  CHECK(rgb[5] > rgb[2]);
  CHECK(rgb[4] < 255);
}

TEST_CASE("Luminaires in under a tenth of the view and unlit pixels do not move the exposure",
          "[image][unit]") {
  Raster raster = uniform(100, 10, Vec3(60, 60, 60));
  const double before = dim::automatic_display_white_cd_m2(raster);
  for (std::size_t i = 0; i < 50; ++i) raster.xyz[3 * i + 1] = 9000;
  for (std::size_t i = 500; i < 900; ++i) raster.xyz[3 * i + 1] = 0;
  raster.xyz[3 * 999 + 1] = std::numeric_limits<float>::quiet_NaN();
  CHECK(dim::automatic_display_white_cd_m2(raster) == before);
}

TEST_CASE("A dark or empty view is black, not an error", "[image][unit]") {
  const auto result = dim::tone_linear(uniform(4, 4, Vec3(0, 0, 0)));
  CHECK(result.display_white_cd_m2 == 1.0);
  CHECK(result.picture.rgb == std::vector<std::uint8_t>(48, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(dim::tone_linear(uniform(1, 1, Vec3(nan, 5, 5))).picture.rgb == std::vector<std::uint8_t>(3, 0));
}

TEST_CASE("The picture is the same for luminances scaled by 1e-12 and 1e12", "[image][unit]") {
  Raster raster = uniform(64, 1, Vec3(0, 0, 0));
  for (std::size_t i = 0; i < raster.xyz.size(); ++i) raster.xyz[i] = static_cast<float>(1 + i);
  const auto picture = dim::tone_linear(raster).picture.rgb;
  for (const float factor : {0x1p-40f, 0x1p40f}) {
    Raster scaled = raster;
    for (float& v : scaled.xyz) v *= factor;
    CHECK(dim::tone_linear(scaled).picture.rgb == picture);
  }
}

TEST_CASE("Dithering keeps the mean of a level between two steps", "[image][unit]") {
  const double level = 100.3;
  const double linear = dim::srgb_decode(level / 255);
  const auto result = dim::tone_linear(uniform(200, 200, Vec3(linear)), {.display_white_cd_m2 = 1});
  double sum = 0;
  for (const auto v : result.picture.rgb) sum += v;
  CHECK(sum / static_cast<double>(result.picture.rgb.size()) == Approx(level).margin(0.01));
}

TEST_CASE("Spectral green is outside sRGB: brought in and counted", "[image][unit]") {
  // CIE 1931 colour-matching functions at 520 nm
  const auto result =
      dim::tone_linear(uniform(2, 2, Vec3(0.06327, 0.71, 0.07825)), {.display_white_cd_m2 = 2});
  CHECK(result.n_out_of_gamut == 4);
  CHECK(result.n_above_white == 0);
}

TEST_CASE("A room under sodium light is shown in its orange, a red one in red", "[image][unit]") {
  // 589 nm and 650 nm on the spectral locus, CIE 1931
  for (const Vec3& light : {Vec3(1.0, 0.7626, 0.0011), Vec3(0.2835, 0.107, 0.0)}) {
    dim::ToneOptions options;
    options.scene_white_xyz = light;
    options.display_white_cd_m2 = 1000;
    const auto result = dim::tone_linear(uniform(1, 1, 50.0 * light), options);
    CHECK(result.picture.rgb[0] > 2 * result.picture.rgb[1]);
    CHECK(result.n_out_of_gamut == 1);
    const dim::LinearPicture linear = dim::exr_pixels(uniform(1, 1, 50.0 * light), light);
    const Vec3 back =
        dim::rgb_to_xyz(linear.primaries) * Vec3(linear.values[0], linear.values[1], linear.values[2]);
    for (int i = 0; i < 3; ++i) CHECK(back[i] == Approx(50 * light[i]).margin(1e-4));
    CHECK(linear.primaries.white.x == Approx(dim::kWhiteD65.x));
  }
}

TEST_CASE("Wrong exposures and rasters are refused", "[image][unit]") {
  const Raster raster = uniform(2, 2, Vec3(1.0));
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(dim::tone_linear(raster, {.display_white_cd_m2 = bad}), dim::InputError);
  }
  Raster wrong = raster;
  wrong.xyz.pop_back();
  CHECK_THROWS_AS(dim::tone_linear(wrong), dim::InternalError);
  wrong = raster;
  wrong.width = 0;
  CHECK_THROWS_AS(dim::tone_linear(wrong), dim::LimitError);
}

TEST_CASE("Radiance pixels hold luminance / 179 and equal parts for equal-energy white", "[image][unit]") {
  const dim::LinearPicture white = dim::radiance_pixels(uniform(1, 1, Vec3(179, 179, 179)));
  for (const float v : white.values) CHECK(v == Approx(1.0f).epsilon(1e-6));
  const dim::LinearPicture green = dim::radiance_pixels(uniform(1, 1, Vec3(6.327, 71, 7.825)));
  const Vec3 rgb(green.values[0], green.values[1], green.values[2]);
  CHECK(glm::dot(rgb, dim::luminance_weights(dim::kRadiancePrimaries)) * 179 == Approx(71).epsilon(1e-6));
  CHECK(green.n_out_of_gamut == 1);
  for (const float v : green.values) CHECK(v >= 0);
}

TEST_CASE("OpenEXR pixels give XYZ back through their primaries, negative components included",
          "[image][unit]") {
  const Vec3 xyz(6.327, 71, 7.825);
  const dim::LinearPicture picture = dim::exr_pixels(uniform(1, 1, xyz), Vec3(1.0));
  const Vec3 rgb(picture.values[0], picture.values[1], picture.values[2]);
  CHECK(rgb.x < 0);
  const Vec3 back = dim::rgb_to_xyz(picture.primaries) * rgb;
  for (int i = 0; i < 3; ++i) CHECK(back[i] == Approx(xyz[i]).epsilon(1e-5));
  CHECK(picture.values[3] == 71.0f);
}
