// Daylight glare against the published formulas, added up another way.
#include <cmath>

#include "catch.hpp"
#include "glare/daylight_glare.hpp"

using namespace dim;

namespace {

const LineOfSight kAhead = LineOfSight::along({1, 0, 0});

// DGP as the paper has it, of one source: written down a second time.
double paper(double ev, double luminance, double solid_angle, double p) {
  const double sum = luminance * luminance * solid_angle / (std::pow(ev, 1.87) * p * p);
  return 5.87e-5 * ev + 9.18e-2 * std::log10(1.0 + sum) + 0.16;
}

}  // namespace

TEST_CASE("A fisheye's pixels fill the half sphere, and their cosines make pi", "[glare][unit]") {
  double whole = 0.0, projected = 0.0;
  for (const auto& pixel : fisheye_pixels(kAhead, 500)) {
    CHECK(glm::length(pixel.towards) == Approx(1.0).epsilon(1e-12));
    whole += pixel.solid_angle_sr;
    projected += pixel.solid_angle_sr * pixel.towards.x;
  }
  CHECK(whole == Approx(2.0 * kPi).epsilon(1e-3));
  CHECK(projected == Approx(kPi).epsilon(1e-4));
}

TEST_CASE("Without glaring pixels DGP is that of the vertical illuminance", "[glare][unit]") {
  auto pixels = fisheye_pixels(kAhead, 200);
  for (auto& pixel : pixels) pixel.luminance_cd_m2 = 1000.0;
  const auto glare = daylight_glare(pixels, kAhead);
  CHECK(glare.n_sources == 0);
  CHECK(glare.vertical_lx == Approx(1000.0 * kPi).epsilon(1e-3));
  CHECK(glare.dgp == Approx(5.87e-5 * glare.vertical_lx + 0.16));
  CHECK(glare.dgps == Approx(6.22e-5 * glare.vertical_lx + 0.184));
}

TEST_CASE("DGP of a round window straight ahead is the paper's", "[glare][unit]") {
  auto pixels = fisheye_pixels(kAhead, 800);
  const double radius = radians(8.0);
  for (auto& pixel : pixels) pixel.luminance_cd_m2 = pixel.towards.x > std::cos(radius) ? 8000.0 : 300.0;
  const auto glare = daylight_glare(pixels, kAhead);
  const double share = std::sin(radius) * std::sin(radius);  // of the projected half sphere
  const double ev = kPi * (8000.0 * share + 300.0 * (1.0 - share)), omega = 2.0 * kPi * (1.0 - std::cos(radius));
  REQUIRE(ev > 1000.0);
  CHECK(glare.n_sources == 1);
  CHECK(glare.vertical_lx == Approx(ev).epsilon(2e-3));
  CHECK(glare.dgp == Approx(paper(ev, 8000.0, omega, 1.0)).margin(2e-3));
}

TEST_CASE("Patches within the search radius are one source, others are not", "[glare][unit]") {
  const auto with_gap = [](double gap_rad) {
    auto pixels = fisheye_pixels(kAhead, 500);
    for (auto& pixel : pixels) {
      const double turn = std::atan2(pixel.towards.y, pixel.towards.x), height = std::asin(pixel.towards.z);
      const bool glares = std::abs(height) < 0.05 && std::abs(turn) > 0.5 * gap_rad && std::abs(turn) < 0.5 * gap_rad + 0.1;
      pixel.luminance_cd_m2 = glares ? 10000.0 : 500.0;
    }
    return daylight_glare(pixels, kAhead).n_sources;
  };
  CHECK(with_gap(0.15) == 1);
  CHECK(with_gap(0.30) == 2);
  CHECK(with_gap(1.2) == 2);
}

TEST_CASE("In little light DGP fades as evalglare has it", "[glare][unit]") {
  auto pixels = fisheye_pixels(kAhead, 200);
  for (auto& pixel : pixels) pixel.luminance_cd_m2 = 60.0;
  const auto glare = daylight_glare(pixels, kAhead);
  const double ev = glare.vertical_lx, power = std::exp(0.024 * ev - 4.0);
  CHECK(glare.dgp == Approx((5.87e-5 * ev + 0.16) * power / (1.0 + power)));
}

TEST_CASE("Far aside the position index ends at 16", "[glare][unit]") {
  CHECK(whole_view_position_index({1, 0, 0}, kAhead) == Approx(1.0));
  CHECK(whole_view_position_index({0.01, 0, 1}, kAhead) == 16.0);
  CHECK(whole_view_position_index({1, 0, -1}, kAhead) == Approx(2.2));
  CHECK(whole_view_position_index({-1, 0, 0}, kAhead) == 16.0);
  CHECK(whole_view_position_index({1, 5, 0.2}, kAhead) <= 16.0);
}
