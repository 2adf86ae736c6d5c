#include "spectrum/colour.hpp"

#include "catch.hpp"

using namespace dim;

namespace {

struct Pair {
  Lab one, other;
  double delta_e;
};

// Sharma, Wu and Dalal 2005, table 1: chosen to go through every branch of the formula. Pair 14 lies on a
// jump of the formula (hues exactly opposite); rounding decides its side, so it is left out.
const Pair kSharma[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0010}, 7.1792},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
    {{50, 2.49, -0.001}, {50, -2.49, 0.0012}, 7.2195},
    {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
    {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
    {{50, -0.001, 2.49}, {50, 0.0012, -2.49}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

}  // namespace

TEST_CASE("CIEDE2000 gives the published differences of Sharma's pairs, both ways", "[spectrum][unit]") {
  for (const auto& pair : kSharma) {
    CAPTURE(pair.one.l, pair.one.a, pair.one.b);
    CHECK(delta_e_2000(pair.one, pair.other) == Approx(pair.delta_e).margin(6e-5));
    CHECK(delta_e_2000(pair.other, pair.one) == Approx(pair.delta_e).margin(6e-5));
  }
  CHECK(delta_e_2000({50, 10, -20}, {50, 10, -20}) == 0.0);
}

TEST_CASE("CIELAB: white is 100, black 0, the curve joins its straight part", "[spectrum][unit]") {
  const Vec3 d65(0.95047, 1.0, 1.08883);
  const Lab white = lab_of(d65, d65), black = lab_of(Vec3(0.0), d65);
  CHECK(white.l == Approx(100.0));
  CHECK(std::abs(white.a) + std::abs(white.b) < 1e-12);
  CHECK(std::abs(black.l) + std::abs(black.a) + std::abs(black.b) < 1e-12);
  // CIE 15: L* = 903.3 Y below (6/29)^3 = 0.008856.
  CHECK(lab_of(0.004 * d65, d65).l == Approx(903.296 * 0.004).epsilon(1e-5));
  CHECK(lab_of(0.0088564 * d65, d65).l == Approx(lab_of(0.0088565 * d65, d65).l).epsilon(1e-4));
  // sRGB red under D65: L* a* b* as published for the primaries of IEC 61966-2-1.
  const Lab red = lab_of({0.4124564, 0.2126729, 0.0193339}, d65);
  CHECK(red.l == Approx(53.24).margin(0.01));
  CHECK(red.a == Approx(80.09).margin(0.01));
  CHECK(red.b == Approx(67.20).margin(0.01));
}

TEST_CASE("Chromaticities of equal energy", "[spectrum][unit]") {
  const Vec3 e(1.0);
  CHECK(xy_of(e).x == Approx(1.0 / 3.0));
  CHECK(uv_1976_of(e).x == Approx(4.0 / 19.0));
  CHECK(uv_1976_of(e).y == Approx(9.0 / 19.0));
  CHECK(uv_1960_of(e).y == Approx(6.0 / 19.0));
  CHECK(std::isnan(xy_of(Vec3(0.0)).x));
}
