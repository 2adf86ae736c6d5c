// Bands chosen for a scene, against enclosures of two walls solved at every wavelength.
#include "spectrum/band_choice.hpp"

#include "catch.hpp"
#include "reference_csv.hpp"
#include "spectrum/colour.hpp"
#include "spectrum/named_spectra.hpp"
#include "spectrum/observer.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// Exitances of two diffuse walls, closed form. Light of unit irradiance falls on the first.
struct Walls {
  double first, second;
};

// Parallel planes: each sees nothing but the other.
Walls planes(double r1, double r2) {
  const double e1 = 1.0 / (1.0 - r1 * r2);
  return {r1 * e1, r2 * r1 * e1};
}

// A floor under a hemisphere, which sees half itself, half the floor.
Walls dome(double r1, double r2) {
  const double e1 = 1.0 / (1.0 - 0.5 * r1 * r2 / (1.0 - 0.5 * r2));
  const double e2 = 0.5 * r1 * e1 / (1.0 - 0.5 * r2);
  return {r1 * e1, r2 * e2};
}

struct Errors {
  double delta_e = 0.0, luminance = 0.0;
};

using Solve = Walls (*)(double, double);

// The walls' colours solved at every fifth nanometre, and in bands.
Errors errors(const SpectralCurve& spd, const SpectralCurve& r1, const SpectralCurve& r2, Solve solve,
              const Bands& bands) {
  const Observer& eye = cie_1931_observer();
  Vec3 white(0.0), exact1(0.0), exact2(0.0), banded1(0.0), banded2(0.0);
  for (double nm = 380; nm <= 780; nm += 5) {
    const double cell = nm == 380 || nm == 780 ? 2.5 : 5.0;
    const Vec3 xyz = cell * spd.at(nm) * Vec3(eye.x.at(nm), eye.y.at(nm), eye.z.at(nm));
    const Walls walls = solve(r1.at(nm), r2.at(nm));
    white += xyz;
    exact1 += walls.first * xyz;
    exact2 += walls.second * xyz;
  }
  const BandWeights weights = band_weights(spd, bands);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double low = bands.low_nm(b), high = bands.high_nm(b);
    const Vec3 xyz = weights.share[b] * Vec3(weights.x[b], weights.y[b], weights.z[b]);
    const Walls walls = solve(r1.mean(low, high), r2.mean(low, high));
    banded1 += walls.first * xyz;
    banded2 += walls.second * xyz;
  }
  double scale = 0.0;
  for (std::size_t b = 0; b < bands.size(); ++b) scale += weights.share[b] * weights.y[b];
  banded1 *= white.y / scale;
  banded2 *= white.y / scale;
  white = glm::max(white, Vec3(1e-9 * white.y));
  return {std::max(delta_e_2000(lab_of(exact1, white), lab_of(banded1, white)),
                   delta_e_2000(lab_of(exact2, white), lab_of(banded2, white))),
          std::max(std::abs(banded1.y / exact1.y - 1.0), std::abs(banded2.y - exact2.y) / exact1.y)};
}

// Bands of 5 nm, the finest.
Bands cells() {
  Bands bands;
  bands.edges_nm.clear();
  for (std::size_t i = 0; i <= kTableSize; ++i) bands.edges_nm.push_back(cell_edge_nm(i));
  return bands;
}

// Smooth colours that need no file: red, green, blue, yellow.
std::vector<SpectralCurve> plain_colours() {
  const auto step = [](double at_nm, double width_nm, double low, double high) {
    std::vector<std::pair<double, double>> points;
    for (double nm = 380; nm <= 780; nm += 5)
      points.emplace_back(nm, low + (high - low) / (1.0 + std::exp((at_nm - nm) / width_nm)));
    return SpectralCurve(points);
  };
  const auto bump = [](double at_nm, double width_nm, double low, double high) {
    std::vector<std::pair<double, double>> points;
    for (double nm = 380; nm <= 780; nm += 5)
      points.emplace_back(nm, low + (high - low) * std::exp(-std::pow((nm - at_nm) / width_nm, 2)));
    return SpectralCurve(points);
  };
  return {step(600, 10, 0.04, 0.65), bump(530, 40, 0.05, 0.5), bump(450, 45, 0.05, 0.55),
          step(510, 12, 0.06, 0.75)};
}

std::vector<SpectralCurve> spectra_named(const std::vector<std::string>& names) {
  std::vector<SpectralCurve> spectra;
  for (const auto& name : names) spectra.push_back(find_spectrum(name));
  return spectra;
}

std::vector<SpectralCurve> columns_of(const std::string& file) {
  const auto table = read_reference(shared_data() / "reflectance" / file);
  if (table.rows.empty()) WARN("skipped: " << file << " is not there");
  std::vector<SpectralCurve> curves;
  for (std::size_t c = 1; c < table.columns.size(); ++c) curves.emplace_back(table.points(table.columns[c]));
  return curves;
}

}  // namespace

TEST_CASE("Grey scenes need one band, whatever the lamps", "[spectrum][bands][unit]") {
  const auto choice =
      choose_bands(spectra_named({"fl-11", "hp-1", "d65"}),
                   {SpectralCurve(0.2), SpectralCurve(0.84), SpectralCurve({{400, 0.5}, {700, 0.5}})});
  CHECK(choice.bands.edges_nm == std::vector<double>{380, 780});
  CHECK(choice.delta_e_2000 < 1e-9);
  CHECK(choose_bands(spectra_named({"e"}), {}).bands.size() == 1);
  CHECK(choose_bands({}, {SpectralCurve(0.5)}).bands.size() == 1);
}

TEST_CASE("Light of one colour alone needs bands only where it shines", "[spectrum][bands][unit]") {
  const auto choice = choose_bands(spectra_named({"lps"}), plain_colours());
  CHECK(choice.bands.size() <= 6);
}

TEST_CASE("Two coloured walls in chosen bands: dE00 <= 0.5, luminance within 0.5 %",
          "[spectrum][bands][unit]") {
  const auto walls = plain_colours();
  for (const std::string lamp : {"cie-a", "d65", "led-b3", "fl-2", "fl-11", "led-rgb1", "hp-4"}) {
    const SpectralCurve spd = find_spectrum(lamp);
    for (std::size_t a = 0; a < walls.size(); ++a) {
      for (std::size_t b = a; b < walls.size(); ++b) {
        const auto choice = choose_bands({spd}, {walls[a], walls[b]});
        for (const Solve solve : {planes, dome}) {
          for (const auto& [first, second] : {std::pair(a, b), std::pair(b, a)}) {
            CAPTURE(lamp, a, b, choice.bands.size());
            const Errors e = errors(spd, walls[first], walls[second], solve, choice.bands);
            CHECK(e.delta_e <= 0.5);
            // The walls show sums of the lights that were looked at: a little more than 0.2 %.
            CHECK(e.luminance <= 4e-3 + errors(spd, walls[first], walls[second], solve, cells()).luminance);
          }
        }
      }
    }
  }
}

TEST_CASE("Measured walls of any two finishes in the bands chosen for all of them",
          "[spectrum][bands][unit]") {
  auto walls = columns_of("colorchecker24_ohta_5nm.csv");
  const auto materials = columns_of("building_materials_5nm.csv");
  walls.insert(walls.end(), materials.begin(), materials.end());
  const std::vector<std::string> lamps = {"cie-a", "d65", "led-4000"};
  const auto choice = choose_bands(spectra_named(lamps), walls);
  Errors worst;
  for (const auto& spd : spectra_named(lamps)) {
    for (const auto& first : walls) {
      for (const auto& second : walls) {
        const Errors e = errors(spd, first, second, dome, choice.bands);
        const double finest = errors(spd, first, second, dome, cells()).luminance;
        worst = {std::max(worst.delta_e, e.delta_e), std::max(worst.luminance, e.luminance - finest)};
      }
    }
  }
  CAPTURE(choice.bands.size());
  CHECK(worst.delta_e <= 0.5);
  CHECK(worst.luminance <= 3e-3);
}

TEST_CASE("ColorChecker patches under D65 and A lie within dE00 0.1 of sums every 5 nm",
          "[spectrum][bands][unit]") {
  const auto patches = columns_of("colorchecker24_ohta_5nm.csv");
  if (patches.empty()) return;
  const auto lamps = spectra_named({"d65", "cie-a"});
  const auto choice = choose_bands(lamps, patches, {.delta_e_2000 = 0.3});
  const auto once = [](double r1, double) { return Walls{r1, r1}; };
  double worst = 0.0;
  for (const auto& lamp : lamps)
    for (const auto& patch : patches)
      worst = std::max(worst, errors(lamp, patch, patch, once, choice.bands).delta_e);
  // 0.3 for all light, twice reflected included, in 45 bands; once reflected it is 0.09.
  CHECK(choice.bands.size() <= 48);
  CHECK(worst <= 0.1);
}

TEST_CASE("Chosen bands cover the visible range, their edges between the wavelengths of the tables",
          "[spectrum][bands][unit]") {
  const auto choice = choose_bands(spectra_named({"d65"}), plain_colours());
  const auto& edges = choice.bands.edges_nm;
  CHECK(edges.front() == 380);
  CHECK(edges.back() == 780);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    CHECK(edges[i] < edges[i + 1]);
    if (i > 0) CHECK(std::fmod(edges[i], 5.0) == 2.5);
  }
  CHECK(choice.delta_e_2000 <= 0.5);
  CHECK(choice.luminance <= 5e-3);  // steps of 50 nm change by more than 0.2 % within 5 nm
}
