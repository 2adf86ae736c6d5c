#include "base/error.hpp"
#include "catch.hpp"
#include "image/colour_space.hpp"

using dim::Vec3;

namespace {
void check_near(const Vec3& a, const Vec3& b, double margin) {
  for (int i = 0; i < 3; ++i) CHECK(a[i] == Approx(b[i]).margin(margin));
}
}  // namespace

TEST_CASE("The matrix of the sRGB primaries is the published one", "[image][unit]") {
  // IEC 61966-2-1:1999, RGB to XYZ, by rows.
  const double published[3][3] = {
      {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
  const glm::dmat3 m = dim::rgb_to_xyz(dim::kSrgbPrimaries);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      CHECK(m[column][row] == Approx(published[row][column]).margin(1e-4));
    }
  }
}

TEST_CASE("D65 white is R = G = B = 1 in sRGB", "[image][unit]") {
  check_near(dim::xyz_to_rgb(dim::kSrgbPrimaries) * dim::xyz_of(dim::kWhiteD65), Vec3(1.0), 1e-12);
  // CIE 15:2018 white point of D65, five digits
  check_near(dim::xyz_of(dim::kWhiteD65), Vec3(0.95047, 1.0, 1.08883), 3e-4);
}

TEST_CASE("Radiance's luminance weights are the published 0.265, 0.670, 0.065", "[image][unit]") {
  check_near(dim::luminance_weights(dim::kRadiancePrimaries), Vec3(0.265, 0.670, 0.065), 5e-4);
}

TEST_CASE("Bradford adaptation carries one white to the other and agrees with the ICC's D65 to D50 matrix",
          "[image][unit]") {
  const Vec3 d65(0.95047, 1.0, 1.08883);
  const Vec3 d50(0.96422, 1.0, 0.82521);
  const glm::dmat3 m = dim::bradford_adaptation(d65 * 7.0, d50);
  check_near(m * d65, d50, 1e-12);
  // Published by Lindbloom, D65 to D50, Bradford, by rows.
  const double published[3][3] = {{1.0478112, 0.0228866, -0.0501270},
                                  {0.0295424, 0.9904844, -0.0170491},
                                  {-0.0092345, 0.0150436, 0.7521316}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      CHECK(m[column][row] == Approx(published[row][column]).margin(1e-4));
    }
  }
}

TEST_CASE("Impossible primaries and whites are refused", "[image][unit]") {
  const dim::Primaries line = {{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, dim::kWhiteD65};
  CHECK_THROWS_AS(dim::rgb_to_xyz(line), dim::InputError);
  CHECK_THROWS_AS(dim::bradford_adaptation(Vec3(0, 0, 0), Vec3(1.0)), dim::InputError);
}

TEST_CASE("Light that the display cannot show is not made neutral", "[image][unit]") {
  for (const dim::Chromaticity& inside : {dim::kWhiteEqualEnergy, {0.4476, 0.4074}, {0.5292, 0.4114}}) {
    const Vec3 white = 3.0 * dim::xyz_of(inside);
    CHECK(dim::neutral_white(white, dim::kSrgbPrimaries) == white);
  }
  // 589 nm and 650 nm on the spectral locus, CIE 1931; no light at all.
  for (const Vec3& outside : {Vec3(1.0, 0.7626, 0.0011), Vec3(0.2835, 0.107, 0.0), Vec3(0.0)}) {
    CHECK(dim::neutral_white(outside, dim::kSrgbPrimaries) == dim::xyz_of(dim::kWhiteD65));
  }
}

TEST_CASE("The sRGB transfer function meets its published points and inverts", "[image][unit]") {
  CHECK(dim::srgb_encode(0.0) == 0.0);
  CHECK(dim::srgb_encode(1.0) == Approx(1.0).margin(1e-12));
  CHECK(dim::srgb_encode(0.0031308) == Approx(0.04045).margin(1e-5));
  CHECK(dim::srgb_encode(0.2140411) == Approx(0.5).margin(1e-6));
  CHECK(dim::srgb_encode(7.0) == Approx(1.0).margin(1e-12));
  for (int i = 0; i <= 255; ++i) CHECK(dim::srgb_encode(dim::srgb_decode(i / 255.0)) == Approx(i / 255.0));
}

TEST_CASE("A colour brought into the gamut keeps its luminance and its hue", "[image][unit]") {
  const Vec3 weights = dim::luminance_weights(dim::kSrgbPrimaries);
  for (const Vec3& rgb :
       {Vec3(0.9, -0.2, 0.1), Vec3(1.6, 0.2, 0.1), Vec3(-0.1, 0.8, 1.3), Vec3(0.2, 0.1, 2.0)}) {
    const dim::InGamut in = dim::bring_into_gamut(rgb, weights);
    CHECK(in.out_of_gamut);
    CHECK_FALSE(in.above_white);
    const double luminance = glm::dot(rgb, weights);
    CHECK(glm::dot(in.rgb, weights) == Approx(luminance).epsilon(1e-12));
    for (int i = 0; i < 3; ++i) CHECK((in.rgb[i] >= 0.0 && in.rgb[i] <= 1.0));
    // Same direction from the grey: same dominant wavelength.
    const Vec3 was = glm::normalize(rgb - Vec3(luminance));
    check_near(glm::normalize(in.rgb - Vec3(luminance)), was, 1e-9);
  }
}

TEST_CASE("Colours inside the gamut are left alone, brighter ones than white become white", "[image][unit]") {
  const Vec3 weights = dim::luminance_weights(dim::kSrgbPrimaries);
  const dim::InGamut inside = dim::bring_into_gamut(Vec3(0.2, 1.0, 0.0), weights);
  CHECK(inside.rgb == Vec3(0.2, 1.0, 0.0));
  CHECK_FALSE(inside.out_of_gamut);
  const dim::InGamut bright = dim::bring_into_gamut(Vec3(3, 2, 1), weights);
  CHECK(bright.rgb == Vec3(1.0));
  CHECK(bright.above_white);
  CHECK_FALSE(bright.out_of_gamut);
  const dim::InGamut black = dim::bring_into_gamut(Vec3(-1, -1, -1), weights);
  CHECK(black.rgb == Vec3(0.0));
}
