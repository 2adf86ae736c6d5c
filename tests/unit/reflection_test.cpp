#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

#include "catch.hpp"
#include "reflection/fresnel.hpp"
#include "reflection/lobe.hpp"
#include "reflection/lobe_kernel.hpp"
#include "reflection/mirror.hpp"
#include "reflection/specular.hpp"
#include "shared_data.hpp"

using namespace dim;

namespace {

Vec3 at_angles(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

BandReflection glossy(double specular, double n, double k = 0.0) {
  BandReflection reflection;
  reflection.specular = specular;
  reflection.n = n;
  reflection.k = k;
  return reflection;
}

}  // namespace

TEST_CASE("Fresnel's law has its limits at normal and grazing incidence", "[reflection][unit]") {
  for (const double n : {1.0, 1.0 + 1e-12, 1.0001, 1.33, 1.5, 2.4, 10.0, 100.0}) {
    CAPTURE(n);
    CHECK(fresnel_reflectance(1.0, n) ==
          Approx(std::pow((n - 1.0) / (n + 1.0), 2)).epsilon(1e-14).margin(0.0));
    CHECK(fresnel_reflectance(0.0, n) == Approx(n == 1.0 ? 0.0 : 1.0).epsilon(1e-14));
    for (double c = 0.0; c <= 1.0; c += 1.0 / 64) {
      const double f = fresnel_reflectance(c, n);
      CHECK(f >= 0.0);
      CHECK(f <= 1.0);
    }
  }
  // A conductor at normal incidence.
  CHECK(fresnel_reflectance(1.0, 0.2, 3.4) == Approx((0.64 + 11.56) / (1.44 + 11.56)).epsilon(1e-14));
  // No light in p at Brewster's angle.
  const double brewster = std::atan(1.5);
  CHECK(fresnel_polarised(std::cos(brewster), 1.5).p < 1e-30);
  // The dielectric and the complex form meet.
  CHECK(fresnel_reflectance(0.3, 1.5, 0.0) == Approx(fresnel_reflectance(0.3, 1.5, 1e-12)).epsilon(1e-10));
  // From glass to air beyond the critical angle everything is reflected.
  CHECK(fresnel_reflectance(0.2, 1.0 / 1.5) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("Fresnel's law agrees with tabulated values", "[reflection][unit]") {
  std::ifstream file;
  if (!test::open_shared(file, "optical_constants/fresnel_check.csv")) return;
  std::string line;
  std::getline(file, line);
  std::vector<std::string> columns;
  std::stringstream header(line);
  for (std::string name; std::getline(header, name, ',');) columns.push_back(name);
  const auto column = [&](const std::string& name) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    REQUIRE(found != columns.end());
    return static_cast<std::size_t>(found - columns.begin());
  };
  int n_rows = 0;
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const double n = std::stod(cells[column("n")]), k = std::stod(cells[column("k")]);
    const double c = std::cos(std::stod(cells[column("incidence_deg")]) * kPi / 180.0);
    CAPTURE(line);
    CHECK(std::abs(fresnel_polarised(c, n, k).s - std::stod(cells[column("R_s")])) <= 1e-6);
    CHECK(std::abs(fresnel_polarised(c, n, k).p - std::stod(cells[column("R_p")])) <= 1e-6);
    ++n_rows;
  }
  CHECK(n_rows >= 200);
}

TEST_CASE("Facets fill the surface's own area, whatever their slope", "[reflection][unit]") {
  for (const auto distribution : {FacetDistribution::gaussian, FacetDistribution::beckmann}) {
    for (const double m : {1e-6, 1e-3, 0.05, 0.3, 1.0, 10.0}) {
      CAPTURE(int(distribution), m);
      const Facets facets(distribution, m);
      // In tan or in delta over m: many steps over where the facets are.
      double sum = 0.0;
      constexpr int kSteps = 200000;
      const double most = distribution == FacetDistribution::gaussian ? std::min(kPi / 2, 7 * m) : kPi / 2;
      for (int i = 0; i < kSteps; ++i) {
        double delta = most * (i + 0.5) / kSteps, width = most / kSteps;
        if (distribution == FacetDistribution::beckmann) {
          const double x = 7.0 * (i + 0.5) / kSteps;
          delta = std::atan(m * x);
          width = 7.0 / kSteps * m / (1 + m * m * x * x);
        }
        sum += facets.density(std::cos(delta)) * std::cos(delta) * 2 * kPi * std::sin(delta) * width;
      }
      // cos(delta) of a tilt of 1e-6 keeps half the digits.
      CHECK(sum == Approx(1.0).epsilon(m < 1e-4 ? 1e-3 : 1e-6));
    }
  }
}

TEST_CASE("Drawn tilts follow the distribution", "[reflection][unit]") {
  // Beckmann: the share of projected area below delta is 1 - exp(-(tan/m)^2).
  const Facets beckmann(FacetDistribution::beckmann, 0.3);
  CHECK(beckmann.tilt_rad(1.0 - std::exp(-1.0)) == Approx(std::atan(0.3)).epsilon(1e-12));
  // Gaussian with small m: 1 - exp(-(delta/m)^2).
  const Facets gaussian(FacetDistribution::gaussian, 1e-4);
  for (const double t : {0.01, 0.1, 0.5, 1.0, 2.0})
    CHECK(gaussian.tilt_rad(-std::expm1(-t * t)) == Approx(1e-4 * t).epsilon(1e-4));
}

TEST_CASE("Specular reflection is reciprocal to rounding", "[reflection][unit]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const auto distribution : {FacetDistribution::gaussian, FacetDistribution::beckmann}) {
    for (const double m : {0.01, 0.1, 0.5, 2.0}) {
      const Facets facets(distribution, m);
      for (int i = 0; i < 500; ++i) {
        const Vec3 a = at_angles(std::acos(unit(random)), 2 * kPi * unit(random));
        const Vec3 b = at_angles(std::acos(unit(random)), 2 * kPi * unit(random));
        const auto reflection = glossy(0.7, 1.0 + 2.0 * unit(random), i % 2 ? 0.0 : 3.0);
        const double there = specular_brdf(reflection, facets, a, b);
        CHECK(specular_brdf(reflection, facets, b, a) == Approx(there).epsilon(1e-12).margin(0.0));
      }
    }
  }
}

TEST_CASE("No finish reflects more than it receives", "[reflection][unit]") {
  for (const auto distribution : {FacetDistribution::gaussian, FacetDistribution::beckmann}) {
    for (const double m : {1e-6, 1e-3, 0.1, 0.5, 1.0, 10.0}) {
      const Facets facets(distribution, m);
      for (const double n : {1.0, 1.5, 100.0, -1.0}) {
        BandReflection reflection = glossy(1.0, n);
        if (n < 0.0) reflection.constant = 1.0;
        for (const double c : {0.0, 1e-9, 0.01, 0.1, 0.5, 0.9, 1.0}) {
          CAPTURE(int(distribution), m, n, c);
          const double albedo = specular_albedo(reflection, &facets, c);
          CHECK(albedo >= 0.0);
          CHECK(albedo <= 1.0);
          if (n == 1.0) CHECK(albedo == 0.0);
          // The mirror limit.
          if (m == 1e-6 && c >= 0.1)
            CHECK(albedo == Approx(specular_albedo(reflection, nullptr, c)).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("The albedo is the integral of the reflectance distribution", "[reflection][unit]") {
  for (const auto distribution : {FacetDistribution::gaussian, FacetDistribution::beckmann}) {
    const Facets facets(distribution, 0.3);
    const auto reflection = glossy(0.8, 1.5);
    for (const double theta : {0.1, 0.7, 1.2}) {
      const Vec3 in = at_angles(theta, 0.0);
      double sum = 0.0;
      constexpr int kTheta = 600, kPhi = 600;
      for (int i = 0; i < kTheta; ++i) {
        const double t = kPi / 2 * (i + 0.5) / kTheta;
        for (int j = 0; j < kPhi; ++j)
          sum += specular_brdf(reflection, facets, in, at_angles(t, kPi * (j + 0.5) / kPhi)) * std::cos(t) *
                 std::sin(t) * (kPi / 2 / kTheta) * 2 * (kPi / kPhi);
      }
      CAPTURE(int(distribution), theta);
      CHECK(specular_albedo(reflection, &facets, std::cos(theta)) == Approx(sum).epsilon(2e-3));
    }
  }
}

TEST_CASE("A lobe on patches keeps its albedo and is reciprocal", "[reflection][unit]") {
  const PatchGrid grid{8, 16};
  for (const double m : {0.02, 0.1, 0.4, 3.0}) {
    const Facets facets(FacetDistribution::gaussian, m);
    const auto reflection = glossy(0.6, 1.5);
    const auto albedo = AlbedoTable(reflection, &facets).of_slices(grid);
    const LobeMatrix lobe(lobe_shape(grid, facets), reflection, albedo);
    std::map<std::array<int, 3>, double> flux;
    for (int a = 0; a < grid.n_slices; ++a) {
      double sum = 0.0;
      for (auto* e = lobe.begin(a); e != lobe.end(a); ++e) {
        CHECK(e->share >= 0.0);
        sum += e->share;
        flux[{a, int(e->slice_out), int(e->turn)}] = e->share * grid.weight_sr(a);
      }
      CAPTURE(m, a);
      CHECK(sum == Approx(albedo[static_cast<std::size_t>(a)]).epsilon(1e-12));
    }
    double worst = 0.0, largest = 0.0;
    for (const auto& [key, value] : flux) {
      const auto other = flux.find({key[1], key[0], (grid.n_sectors - key[2]) % grid.n_sectors});
      REQUIRE(other != flux.end());
      worst = std::max(worst, std::abs(other->second - value));
      largest = std::max(largest, value);
    }
    CHECK(worst <= 2e-3 * largest);
    // A narrow lobe leaves where a mirror would send it.
    if (m == 0.02) {
      for (int a = 4; a < 8; ++a) CHECK(flux[{a, a, 8}] > 0.5 * albedo[std::size_t(a)] * grid.weight_sr(a));
    }
  }
}

TEST_CASE("Facets are drawn as they are distributed", "[reflection][unit]") {
  // Chi-square of drawn facets against the density, over tilt and azimuth about an oblique direction.
  const auto distribution = GENERATE(FacetDistribution::gaussian, FacetDistribution::beckmann);
  const double m = GENERATE(0.05, 0.3, 1.0);
  const Facets facets(distribution, m);
  constexpr int kTilts = 24, kAzimuths = 8, kDraws = 200000, kFine = 400;
  const double most = std::min(kPi / 2, 3.0 * m);  // beyond: one bin more
  std::vector<double> expected(kTilts * kAzimuths + 1, 0.0), drawn(expected.size(), 0.0);
  for (int t = 0; t < kTilts; ++t) {
    double share = 0.0;
    for (int i = 0; i < kFine; ++i) {
      const double delta = most * (t + (i + 0.5) / kFine) / kTilts;
      share += facets.density(std::cos(delta)) * std::cos(delta) * std::sin(delta) * 2 * kPi * most /
               (kTilts * kFine);
    }
    for (int a = 0; a < kAzimuths; ++a) expected[std::size_t(t * kAzimuths + a)] = share * kDraws / kAzimuths;
  }
  expected.back() = kDraws - std::accumulate(expected.begin(), expected.end(), 0.0);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Vec3 in = at_angles(0.6, 0.3);
  for (int i = 0; i < kDraws; ++i) {
    const auto facet = sample_facet(facets, in, unit(random), unit(random));
    // The facet stands half-way between the directions in and out, or opposite where it faces away.
    Vec3 half = glm::normalize(in + facet.out);
    if (half.z < 0.0) half = -half;
    const int t = static_cast<int>(std::acos(std::min(1.0, half.z)) / most * kTilts);
    const double turn = std::atan2(half.y, half.x) / (2 * kPi);
    const int a = std::min(kAzimuths - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * kAzimuths));
    ++drawn[t < kTilts ? std::size_t(t * kAzimuths + a) : expected.size() - 1];
  }
  double chi2 = 0.0;
  int n_bins = 0;
  for (std::size_t b = 0; b < expected.size(); ++b) {
    if (expected[b] < 5.0) continue;
    chi2 += (drawn[b] - expected[b]) * (drawn[b] - expected[b]) / expected[b];
    ++n_bins;
  }
  CAPTURE(int(distribution), m, n_bins, chi2);
  // Mean n - 1, variance 2 (n - 1): four standard deviations.
  CHECK(chi2 < n_bins - 1 + 4.0 * std::sqrt(2.0 * (n_bins - 1)));
  CHECK(n_bins > 20);
}

TEST_CASE("A lobe's skirts are those of the distribution", "[reflection][unit]") {
  // Patches that receive between 1/3000 and 1/100 of the most: what a coarser limit of what counts would
  // lose.
  const PatchGrid grid{16, 32};
  const Facets facets(FacetDistribution::gaussian, 0.15);
  BandReflection reflection;
  reflection.specular = 1.0;
  reflection.constant = 0.6;
  const auto albedo = AlbedoTable(reflection, &facets).of_slices(grid);
  const LobeMatrix lobe(lobe_shape(grid, facets), reflection, albedo);
  for (const int slice : {6, 11, 14}) {
    constexpr int kIn = 4, kOut = 6;
    std::vector<double> exact(grid.n_patches(), 0.0), found(grid.n_patches(), 0.0);
    for (int i = 0; i < kIn * kIn; ++i) {
      const Vec3 in = grid.direction(slice, 0, (i % kIn + 0.5) / kIn, (i / kIn + 0.5) / kIn);
      for (std::size_t p = 0; p < exact.size(); ++p) {
        for (int o = 0; o < kOut * kOut; ++o) {
          const Vec3 out = grid.direction(int(p) / grid.n_sectors, int(p) % grid.n_sectors,
                                          (o % kOut + 0.5) / kOut, (o / kOut + 0.5) / kOut);
          exact[p] += specular_brdf(reflection, facets, in, out) * grid.weight_sr(int(p) / grid.n_sectors) /
                      (kIn * kIn * kOut * kOut);
        }
      }
    }
    for (const auto* e = lobe.begin(slice); e != lobe.end(slice); ++e)
      found[e->slice_out * std::size_t(grid.n_sectors) + e->turn] += e->share;
    const double most = *std::max_element(exact.begin(), exact.end());
    double skirt_exact = 0.0, skirt_found = 0.0;
    for (std::size_t p = 0; p < exact.size(); ++p) {
      if (exact[p] < most / 3000 || exact[p] > most / 100) continue;
      skirt_exact += exact[p];
      skirt_found += found[p];
    }
    CAPTURE(slice, skirt_exact, skirt_found);
    CHECK(skirt_exact > 1e-3 * albedo[std::size_t(slice)]);
    CHECK(skirt_found == Approx(skirt_exact).epsilon(0.1));
  }
}

TEST_CASE("A lobe applied to many columns is its matrix, sector by sector", "[reflection][unit]") {
  const auto grid = GENERATE(PatchGrid{8, 16}, PatchGrid{9, 21}, PatchGrid{7, 5}, PatchGrid{1, 1});
  const std::size_t n_columns = GENERATE(1U, 3U, 8U);
  const Facets facets(FacetDistribution::gaussian, 0.3);
  const auto reflection = glossy(0.8, 3.0);
  const LobeMatrix lobe(lobe_shape(grid, facets), reflection,
                        AlbedoTable(reflection, &facets).of_slices(grid));
  const LobeKernel kernel(lobe, grid);
  const std::size_t stride = n_columns + 2, n = grid.n_patches(), n_sectors = std::size_t(grid.n_sectors);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> in(n * stride), out(n * stride, -1.0), scratch(kernel.n_scratch(n_columns));
  for (double& x : in) x = unit(random);
  kernel.apply(in.data(), out.data(), n_columns, stride, scratch.data());
  std::vector<double> expected(n * n_columns, 0.0);
  for (std::size_t p = 0; p < n; ++p) {
    const int slice = static_cast<int>(p / n_sectors);
    for (const auto* e = lobe.begin(slice); e != lobe.end(slice); ++e) {
      const std::size_t to = e->slice_out * n_sectors + (p + e->turn) % n_sectors;
      const std::size_t sector = (p % n_sectors + e->turn) % n_sectors;
      REQUIRE(to / n_sectors == e->slice_out);
      for (std::size_t c = 0; c < n_columns; ++c)
        expected[(e->slice_out * n_sectors + sector) * n_columns + c] += e->share * in[p * stride + c];
    }
  }
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t c = 0; c < n_columns; ++c)
      REQUIRE(out[p * stride + c] == Approx(expected[p * n_columns + c]).epsilon(1e-12));
    for (std::size_t c = n_columns; c < stride; ++c) REQUIRE(out[p * stride + c] == -1.0);
  }
}

TEST_CASE("A line that meets mirrors turns at each and loses what each takes at its angle",
          "[reflection][unit]") {
  // Down on a floor and on to a wall: the angles add up to a right one.
  std::vector<BandReflection> floor(2, glossy(0.9, 1.5)), wall(2, glossy(1.0, 3.0));
  floor[1].constant = 0.5;
  const double theta = 1.05;
  Vec3 direction(std::sin(theta), 0.0, -std::cos(theta));
  std::vector<double> tint{1.0, 0.8};
  const double left = meet_mirror({0, 0, 1}, direction, tint, [&](std::size_t k) { return floor[k]; });
  CHECK(glm::length(direction - Vec3(std::sin(theta), 0.0, std::cos(theta))) < 1e-15);
  CHECK(tint[0] == Approx(0.9 * fresnel_reflectance(std::cos(theta), 1.5)).epsilon(1e-12));
  CHECK(tint[1] == Approx(0.8 * 0.9 * 0.5).epsilon(1e-12));
  CHECK(left == tint[1]);
  meet_mirror({-1, 0, 0}, direction, tint, [&](std::size_t k) { return wall[k]; });
  CHECK(glm::length(direction - Vec3(-std::sin(theta), 0.0, std::cos(theta))) < 1e-15);
  CHECK(tint[0] ==
        Approx(0.9 * fresnel_reflectance(std::cos(theta), 1.5) * fresnel_reflectance(std::sin(theta), 3.0))
            .epsilon(1e-12));
}
