#include "catch.hpp"
#include "property/transport_support.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/observer.hpp"
#include "transport/auto_bands.hpp"

using namespace dim;
using namespace dim::test;

namespace {

double closed_form_lx(const SpectralCurve& spd, const SpectralCurve& rho, double flux_lm, double area_m2) {
  double received = 0.0, emitted = 0.0;
  for (double nm = 380; nm <= 780; nm += 5) {
    const double seen = (nm == 380 || nm == 780 ? 2.5 : 5.0) * spd.at(nm) * photopic_efficiency().at(nm);
    received += seen / (1.0 - rho.at(nm));
    emitted += seen;
  }
  return flux_lm / area_m2 * received / emitted;
}

}  // namespace

TEST_CASE("A cube of one strong colour has the illuminance of its closed form in the bands chosen for it",
          "[validation][bands]") {
  const SpectralCurve spd = find_spectrum("led-b3");
  const std::pair<SpectralCurve, double> walls[] = {
      {SpectralCurve({{380, 0.05}, {560, 0.06}, {620, 0.75}, {780, 0.8}}), 29.54},
      {SpectralCurve({{380, 0.5}, {480, 0.6}, {540, 0.15}, {780, 0.05}}), 23.022}};
  Zone zone = box_zone({3, 3, 3}, 0.5, 0.5);
  const Network network = network_of(zone, {8, 16});
  const Cells cells(zone);
  Lights lights = point_lamp({0, 0, 0}, 1000.0 / (4.0 * kPi));
  lights.fittings[0].spectrum = spd;
  for (const auto& [rho, expected_lx] : walls) {
    REQUIRE(closed_form_lx(spd, rho, 1000.0, 54.0) == Approx(expected_lx).epsilon(1e-4));
    zone.finishes[0].diffuse = rho;
    SimulationOptions options;
    options.bands = auto_bands(zone, lamp_spectra(lights)).bands;
    const auto solution = solve(zone, lights, network, options);
    CHECK(total(cells, cell_lx(solution)) / 54.0 == Approx(expected_lx).epsilon(3e-3));
    // One band, luminous reflectance: the first reflection is right, those after it are not.
    options.bands = Bands{};
    const auto one = solve(zone, lights, network, options);
    const double wrong = total(cells, cell_lx(one)) / 54.0 / expected_lx - 1.0;
    const BandChoice estimate = judged_bands(zone, lamp_spectra(lights), Bands{});
    CHECK_FALSE(estimate.is_enough());
    CHECK(std::abs(wrong) < estimate.luminance);
  }
}
