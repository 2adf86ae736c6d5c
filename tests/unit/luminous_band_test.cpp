// One band reflects with the luminous reflectance under the lamps.
#include "catch.hpp"
#include "database/finish_figures.hpp"
#include "property/transport_support.hpp"
#include "result/luminous.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/observer.hpp"
#include "transport/auto_bands.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const SpectralCurve kRed({{380, 0.04}, {560, 0.05}, {620, 0.6}, {780, 0.7}});

Zone red_room() {
  Zone zone = box_zone({4, 3, 2.7}, 0.5, 1.0);
  zone.surfaces[2].finish = add_grey(zone, 0.5);
  zone.finishes.back().diffuse = kRed;
  return zone;
}

Lights lit_by(const std::string& spectrum) {
  Lights lights = point_lamp({0, 0, 1}, 100.0);
  lights.fittings[0].spectrum = find_spectrum(spectrum);
  lights.fittings[0].has_spectrum = true;
  return lights;
}

// sum V S rho / sum V S, every nanometre.
double luminous_reflectance(const SpectralCurve& spd, const SpectralCurve& rho) {
  double reflected = 0.0, all = 0.0;
  for (double nm = 380; nm <= 780; nm += 1) {
    const double seen = spd.at(nm) * photopic_efficiency().at(nm);
    reflected += seen * rho.at(nm);
    all += seen;
  }
  return reflected / all;
}

}  // namespace

TEST_CASE("In one band, pi L over E is the luminous reflectance under the lamp", "[bands][unit]") {
  const Zone zone = red_room();
  const Cells cells(zone);
  for (const std::string lamp : {"d65", "cie-a", "led-b3"}) {
    const Lights lights = lit_by(lamp);
    const LuminanceDatabase database(zone, cells, lights, solve(zone, lights, network_of(zone, {2, 4})));
    CHECK(database.classes().luminous);
    const auto seen = cell_appearance(database, cells, {1.0});
    const std::size_t i = cells.first(2);
    const double rho = kPi * seen.xyz_cd_m2[i].y / seen.illuminance_lx[i];
    CAPTURE(lamp);
    CHECK(rho == Approx(luminous_reflectance(find_spectrum(lamp), kRed)).epsilon(2e-3));
    // What `dimdbm list` shows is that of daylight.
    if (lamp == "d65") CHECK(rho == Approx(finish_xyz(zone.finishes.back(), find_spectrum("d65")).y).epsilon(2e-3));
  }
}

TEST_CASE("Lamps weigh by their flux in the reflectance of one band", "[bands][unit]") {
  const auto d65 = find_spectrum("d65"), a = find_spectrum("cie-a");
  const auto mean = [&](const std::vector<double>& flux_lm) {
    const LatticeValues weights = luminous_weights({d65, a}, flux_lm);
    double sum = 0.0, rho = 0.0;
    for (std::size_t i = 0; i < kTableSize; ++i) sum += weights[i], rho += weights[i] * kRed.at(lattice_nm(i));
    CHECK(sum == Approx(1.0).epsilon(1e-12));
    return rho;
  };
  const double cold = luminous_reflectance(d65, kRed), warm = luminous_reflectance(a, kRed);
  CHECK(mean({1.0, 0.0}) == Approx(cold).epsilon(2e-3));
  CHECK(mean({0.0, 5.0}) == Approx(warm).epsilon(2e-3));
  CHECK(mean({300.0, 100.0}) == Approx(0.75 * cold + 0.25 * warm).epsilon(2e-3));
  CHECK(mean({0.0, 0.0}) == Approx(0.5 * cold + 0.5 * warm).epsilon(2e-3));
}

TEST_CASE("Grey finishes are the same in one band whatever the lamps", "[bands][unit]") {
  const Zone zone = box_zone({4, 3, 2.7}, 0.37, 1.0);
  const auto weights = luminous_weights({find_spectrum("fl-11")}, {1.0});
  const auto classes = classify(zone, Bands{}, false, &weights);
  CHECK_FALSE(classes.luminous);
  CHECK(classes.at(0, 0).diffuse == 0.37);
}

TEST_CASE("The estimate for bands chosen by hand is that of the search for the same bands", "[bands][unit]") {
  const Zone zone = red_room();
  const LampSpectra lamps = lamp_spectra(lit_by("led-b3"));
  const BandChoice found = auto_bands(zone, lamps), judged = judged_bands(zone, lamps, found.bands);
  CHECK(judged.delta_e_2000 == Approx(found.delta_e_2000).epsilon(1e-9));
  CHECK(judged.luminance == Approx(found.luminance).epsilon(1e-9));
  CHECK(judged.is_enough());
  CHECK_FALSE(judged_bands(zone, lamps, Bands::uniform(1)).is_enough());
  CHECK_FALSE(judged_bands(zone, lamps, Bands::uniform(3)).is_enough());
  // Nothing is off in a grey room.
  CHECK(judged_bands(box_zone({4, 3, 2.7}, 0.5, 1.0), lamps, Bands::uniform(7)).off < 1e-9);
}

TEST_CASE("Another spectrum after the solution is the one before it", "[result][unit]") {
  const Zone zone = red_room();
  const Cells cells(zone);
  const Network network = network_of(zone, {4, 6});
  SimulationOptions options;
  options.bands = Bands::uniform(7);
  const Lights before = lit_by("cie-a"), after = lit_by("fl-2");
  LuminanceDatabase changed(zone, cells, before, solve(zone, before, network, options));
  changed.set_spectrum(0, find_spectrum("fl-2"));
  const LuminanceDatabase solved(zone, cells, after, solve(zone, after, network, options));
  const auto a = cell_appearance(changed, cells, {1.0}), b = cell_appearance(solved, cells, {1.0});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CHECK(a.illuminance_lx[i] == Approx(b.illuminance_lx[i]).epsilon(1e-12));
    for (int axis = 0; axis < 3; ++axis) CHECK(a.xyz_cd_m2[i][axis] == Approx(b.xyz_cd_m2[i][axis]).epsilon(1e-12));
  }
  for (std::size_t band = 0; band < 7; ++band) {
    const auto &e = changed.sources()[0].energy[band], &f = solved.sources()[0].energy[band];
    CHECK(e.emitted_W == Approx(f.emitted_W).epsilon(1e-12));
    CHECK(e.absorbed_W == Approx(f.absorbed_W).epsilon(1e-9));
    CHECK(e.imbalance == Approx(f.imbalance).margin(1e-12));
  }
  // One band's reflectances are those under the lamp it was solved with.
  LuminanceDatabase one(zone, cells, before, solve(zone, before, network));
  CHECK_THROWS_AS(one.set_spectrum(0, find_spectrum("fl-2")), InputError);
}

TEST_CASE("The worst balance is that of a source and band, not of the sum", "[simulate][unit]") {
  std::vector<Source> sources(2);
  sources[0].energy = {{10.0, 0, 0, 0, 0, 1e-4}, {0.0, 0, 0, 0, 0, 0.5}};  // no light: no balance
  sources[1].energy = {{10.0, 0, 0, 0, 0, 3e-3}, {10.0, 0, 0, 0, 0, -4e-3}};
  const WorstBalance worst = worst_balance(sources);
  CHECK(worst.source == 1);
  CHECK(worst.band == 1);
  CHECK(worst.imbalance == -4e-3);
  CHECK(worst_balance({}).imbalance == 0.0);
}

TEST_CASE("Light beyond single precision is refused by the source's name", "[simulate][unit]") {
  const Zone zone = box_zone({2, 2, 2}, 0.5, 1.0);
  Lights lights = point_lamp({0, 0, 0}, 100.0);
  add_lamp(lights, "sun", {0, 0, 0.1}, IntensityTable::isotropic(1.0), {.factor = 1e100});
  const Network network = network_of(zone, {1, 2});
  for (const double factor : {1e100, 1e300}) {
    lights.luminaires[1].factor = factor;
    std::string message;
    try {
      solve(zone, lights, network);
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK(message.find("'sun'") != std::string::npos);
  }
}
