#include "spectrum/bands.hpp"

#include <numeric>

#include "catch.hpp"
#include "spectrum/observer.hpp"

using namespace dim;

TEST_CASE("Shares of a source over bands add up to one", "[spectrum][property]") {
  const SpectralCurve slope({{380, 0.1}, {500, 1.0}, {780, 3.0}});
  for (const int n : {1, 3, 9, 81}) {
    const auto weights = band_weights(slope, Bands::uniform(n));
    CHECK(std::accumulate(weights.share.begin(), weights.share.end(), 0.0) == Approx(1.0).epsilon(1e-14));
    // Watts times band responses give the lumens back, however many bands.
    double lumens_per_watt = 0.0;
    for (std::size_t b = 0; b < weights.share.size(); ++b)
      lumens_per_watt += kMaxEfficacy_lm_W * weights.share[b] * weights.y[b];
    CHECK(lumens_per_watt == Approx(weights.efficacy_lm_W).epsilon(1e-12));
  }
}

TEST_CASE("Equal-energy light has the chromaticity of illuminant E", "[spectrum][unit]") {
  const auto weights = band_weights(SpectralCurve(1.0), Bands{});
  const double sum = weights.x[0] + weights.y[0] + weights.z[0];
  // CIE 15: x = y = 1/3; the 5 nm tables give it to the fourth decimal.
  CHECK(weights.x[0] / sum == Approx(1.0 / 3.0).margin(1e-4));
  CHECK(weights.y[0] / sum == Approx(1.0 / 3.0).margin(1e-4));
  // The integral of V is 106.857 nm (sum of the CIE 1 nm table): K of equal-energy radiation over 400 nm.
  CHECK(weights.efficacy_lm_W == Approx(683.0 * 106.857 / 400.0).epsilon(1e-4));
}

TEST_CASE("The observer peaks at 555 nm and is linear between its points", "[spectrum][unit]") {
  const auto& eye = cie_1931_observer();
  CHECK(eye.y.at(555) == Approx(1.0));
  CHECK(eye.y.at(557.5) == Approx((eye.y.at(555) + eye.y.at(560)) / 2));
}

TEST_CASE("A curve's mean is exact for straight lines and constant beyond its ends", "[spectrum][unit]") {
  const SpectralCurve ramp({{400, 0.0}, {500, 1.0}});
  CHECK(ramp.mean(400, 500) == Approx(0.5));
  CHECK(ramp.mean(380, 420) == Approx((0.5 * 20 * 0.2) / 40));
  CHECK(ramp.mean(450, 650) == Approx((50 * 0.75 + 150 * 1.0) / 200));
  CHECK(ramp.at(300) == 0.0);
  CHECK(ramp.at(900) == 1.0);
  CHECK(SpectralCurve(0.3).mean(380, 780) == 0.3);
  CHECK(SpectralCurve(0.3).is_flat());
}

TEST_CASE("Bands share out what lies across an edge; a narrow line is not missed", "[spectrum][unit]") {
  // A line of 1 nm half width between two of the wavelengths that are summed: all its power, its own colour.
  const SpectralCurve line({{553, 0}, {554, 1}, {555, 0}});
  const auto whole = band_weights(line, Bands{});
  CHECK(whole.y[0] == Approx(cie_1931_observer().y.at(555)).epsilon(1e-12));
  const auto split = band_weights(SpectralCurve(1.0), Bands{{380, 503, 780}});
  CHECK(split.share[0] == Approx(123.0 / 400).epsilon(1e-12));
  CHECK(on_lattice(line)[35] == Approx(1.0 / 5).epsilon(1e-12));
}
