// Off-specular and mirror surfaces against closed forms, quadrature, each other and the balance of energy.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "reflection/specular.hpp"

using namespace dim;
using namespace dim::test;

namespace {

enum Face { kFloor, kCeiling, kY0, kY1, kX0, kX1 };

// A box of 4 x 3 x 2.5 m whose faces have a finish each, all grey at first.
Zone room(double reflectance, double cell_m = 0.25) {
  Zone zone = box_zone({4, 3, 2.5}, reflectance, cell_m);
  for (int face = 0; face < 6; ++face) zone.surfaces[std::size_t(face)].finish = add_grey(zone, reflectance);
  return zone;
}

Finish& finish_of(Zone& zone, int face) {
  return zone.finishes[static_cast<std::size_t>(zone.surfaces[static_cast<std::size_t>(face)].finish)];
}

void make_mirror(Zone& zone, int face, double reflectance) {
  Finish& finish = finish_of(zone, face);
  finish.specular = 1.0;
  finish.diffuse = SpectralCurve(0.0);
  finish.roughness = 0.0;
  finish.specular_reflectance = SpectralCurve(reflectance);
}

void make_glossy(Zone& zone, int face, double specular, double roughness, double ior, double diffuse = 0.3) {
  Finish& finish = finish_of(zone, face);
  finish.specular = specular;
  finish.diffuse = SpectralCurve(diffuse);
  finish.roughness = roughness;
  finish.ior = SpectralCurve(ior);
}

double worst_imbalance(const Solution& solution) {
  double worst = 0.0;
  for (const auto& source : solution.sources) {
    for (const auto& energy : source.energy) worst = std::max(worst, std::abs(energy.imbalance));
  }
  return worst;
}

double inverse_square_lx(const Vec3& p, const Vec3& n, const Vec3& lamp, double cd) {
  const Vec3 d = lamp - p;
  return cd * std::max(0.0, glm::dot(n, d)) / std::pow(glm::length(d), 3);
}

std::vector<double> surface_means(const Zone& zone, const std::vector<double>& lx) {
  const Cells cells(zone);
  std::vector<double> means;
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
      sum += cells.area_m2(i) * lx[i];
      area += cells.area_m2(i);
    }
    means.push_back(sum / area);
  }
  return means;
}

}  // namespace

TEST_CASE("A point source before a plane mirror lights as itself and its image", "[shine][unit]") {
  Zone zone = room(0.0);
  make_mirror(zone, kX0, 0.85);
  for (int i = 0; i < 12; ++i) zone.points.push_back({{-1.9 + 0.33 * i, 0.1 * i - 0.5, -1.2}, {0, 0, 1}});
  const Vec3 lamp(-0.7, 0.2, 0.6), image(-3.3, 0.2, 0.6);
  const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone));
  const auto lx = point_lx(solution);
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const Vec3& p = zone.points[i].position;
    CHECK(lx[i] == Approx(inverse_square_lx(p, {0, 0, 1}, lamp, 100) +
                          0.85 * inverse_square_lx(p, {0, 0, 1}, image, 100))
                       .epsilon(1e-6));
  }
  CHECK(worst_imbalance(solution) < 1e-4);
}

TEST_CASE("Light passes a mirror's edge, and back to front not at all", "[shine][unit]") {
  // A mirror panel of 1 x 1 m in the middle of a black wall.
  Zone zone = room(0.0);
  zone.finishes.push_back({});
  zone.finishes.back().name = "panel";
  zone.finishes.back().specular = 1.0;
  zone.finishes.back().specular_reflectance = SpectralCurve(1.0);
  add_surface(zone, "panel", {{-1.9, -0.5, -0.5}, {-1.9, 0.5, -0.5}, {-1.9, 0.5, 0.5}, {-1.9, -0.5, 0.5}},
              static_cast<int>(zone.finishes.size()) - 1, 0.25);
  zone.surfaces.back().bounding = false;
  const Vec3 lamp(0, 0, 0);
  // The image is at x = -3.8: its light reaches z = -1.25 + h where the line through the panel's lower edge
  // does.
  for (const double x : {-1.0, 0.5, 1.2, 1.9}) zone.points.push_back({{x, 0.0, -0.9}, {0, 0, 1}});
  const auto lx = point_lx(solve(zone, point_lamp(lamp, 100.0), network_of(zone)));
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const Vec3& p = zone.points[i].position;
    const Vec3 image(-3.8, 0, 0);
    const double z_on_panel = image.z + (p.z - image.z) * (-1.9 - image.x) / (p.x - image.x);
    const double expected = inverse_square_lx(p, {0, 0, 1}, lamp, 100) +
                            (std::abs(z_on_panel) < 0.5 ? inverse_square_lx(p, {0, 0, 1}, image, 100) : 0.0);
    CAPTURE(p.x, z_on_panel);
    CHECK(lx[i] == Approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("A lobe lights a point as the quadrature of its distribution says", "[shine][property]") {
  Zone zone = room(0.0, 0.1);
  make_glossy(zone, kFloor, 1.0, 0.3, 3.0);
  const Vec3 lamp(-0.6, 0.1, 0.3);
  for (int i = 0; i < 6; ++i) zone.points.push_back({{-1.5 + 0.6 * i, 0.2, 1.2}, {0, 0, -1}});
  const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone, {32, 64}));
  const auto reflection = band_reflection(finish_of(zone, kFloor), 380, 780);
  const Facets facets(FacetDistribution::gaussian, 0.3);
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const Vec3 p = zone.points[i].position;
    double expected = 0.0;
    constexpr int kX = 400, kY = 300;
    for (int x = 0; x < kX; ++x) {
      for (int y = 0; y < kY; ++y) {
        const Vec3 q(-2 + 4 * (x + 0.5) / kX, -1.5 + 3 * (y + 0.5) / kY, -1.25);
        const Vec3 out = p - q;
        const double r2 = glm::dot(out, out), cosine = out.z / std::sqrt(r2);
        const double luminance =
            inverse_square_lx(q, {0, 0, 1}, lamp, 100) *
            specular_brdf(reflection, facets, glm::normalize(lamp - q), glm::normalize(out));
        expected += luminance * cosine * cosine / r2 * (4.0 / kX) * (3.0 / kY);
      }
    }
    const double direct = illuminance_lx(solution, solution.point_direct, 0, solution.n_points)[i];
    CAPTURE(i, direct, expected);
    CHECK(point_lx(solution)[i] - direct == Approx(expected).epsilon(0.04));
  }
}

TEST_CASE("What a mirror sends out of an open zone has escaped", "[shine][unit]") {
  Zone zone = room(0.5);
  make_mirror(zone, kFloor, 0.9);
  zone.surfaces.resize(1);
  const auto solution = solve(zone, point_lamp({-0.7, 0.2, 0.6}, 100.0), network_of(zone, {8, 16}));
  const auto& energy = solution.sources[0].energy[0];
  CHECK(energy.escaped_W == Approx(energy.emitted_W - energy.absorbed_W).epsilon(1e-2));
  CHECK(worst_imbalance(solution) < 1e-2);
}

TEST_CASE("Energy closes with lobes, mirrors and both", "[shine][property]") {
  const int kind = GENERATE(0, 1, 2, 3);
  Zone zone = room(0.6);
  if (kind == 0 || kind == 2) make_glossy(zone, kFloor, 0.4, 0.15, 1.7);
  if (kind == 1 || kind == 2) make_mirror(zone, kX0, 0.9);
  if (kind == 3) {
    make_glossy(zone, kFloor, 0.9, 0.25, 0.4);
    finish_of(zone, kFloor).extinction = SpectralCurve({{400, 2.0}, {500, 2.5}, {700, 4.0}});
    finish_of(zone, kFloor).distribution = "beckmann";
  }
  Lights lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
  add_lamp(lights, "panel", {0.5, -0.5, 1.2}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(0.6, 0.6)});
  SimulationOptions options;
  options.bands = Bands::uniform(kind == 3 ? 4 : 1);
  const auto solution = solve(zone, lights, network_of(zone), options);
  CAPTURE(kind);
  CHECK(worst_imbalance(solution) < 2e-3);
  for (const float e : solution.cell_total) CHECK(e >= 0.0F);
}

TEST_CASE("Gathering and tracking agree", "[shine][track][property]") {
  const int kind = GENERATE(0, 1, 2, 3);
  Zone zone = room(0.5);
  if (kind == 1 || kind == 3) make_glossy(zone, kFloor, 0.5, 0.2, 2.0);
  if (kind == 2 || kind == 3) make_mirror(zone, kX0, 0.9);
  for (int i = 0; i < 8; ++i) zone.points.push_back({{-1.7 + 0.45 * i, 0.2, -0.5}, {0, 0, 1}});
  const auto lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
  const Network network = network_of(zone);
  const auto gathered = solve(zone, lights, network);
  SimulationOptions options;
  options.solver = Solver::track;
  options.track.threshold = 1e-6;
  const auto tracked = solve(zone, lights, network, options);
  CAPTURE(kind);
  CHECK(worst_imbalance(tracked) < 2e-3);
  // At most the threshold of each cell is dropped.
  CHECK(tracked.sources[0].residual <= 1e-6 * static_cast<double>(tracked.n_cells));
  const auto a = surface_means(zone, cell_lx(gathered)), b = surface_means(zone, cell_lx(tracked));
  for (std::size_t s = 0; s < a.size(); ++s) CHECK(b[s] == Approx(a[s]).epsilon(1e-2));
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    CHECK(point_lx(tracked)[i] == Approx(point_lx(gathered)[i]).epsilon(1e-2));
}

TEST_CASE("What is dropped by tracking falls with the threshold", "[track][unit]") {
  const Zone zone = room(0.5, 0.5);
  const Network network = network_of(zone, {4, 8});
  const auto lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
  double before = 1.0;
  for (const double threshold : {1e-2, 1e-3, 1e-4, 1e-5}) {
    SimulationOptions options;
    options.solver = Solver::track;
    options.track.threshold = threshold;
    const auto solution = solve(zone, lights, network, options);
    CHECK(solution.sources[0].residual < before);
    before = solution.sources[0].residual;
    CHECK(worst_imbalance(solution) < 1e-3);
  }
  CHECK(before < 5e-3);
}

TEST_CASE("A lobe without light is no lobe, and a narrow one a mirror", "[shine][unit]") {
  const auto lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
  Zone glossy = room(0.5), plain = room(0.5);
  make_glossy(glossy, kFloor, 0.4, 0.2, 1.0, 0.5);
  finish_of(plain, kFloor).diffuse = SpectralCurve(0.6 * 0.5);
  const Network network = network_of(plain);
  const auto without = solve(glossy, lights, network);
  CHECK(without.plan.off_specular.empty());
  CHECK(without.cell_total == solve(plain, lights, network).cell_total);

  Zone narrow = room(0.5), mirror = room(0.5);
  make_glossy(narrow, kFloor, 0.4, 1e-4, 2.0);
  make_glossy(mirror, kFloor, 0.4, 0.0, 2.0);
  const auto as_mirror = solve(narrow, lights, network);
  CHECK(as_mirror.plan.mirrors.size() == 1);
  CHECK(as_mirror.cell_total == solve(mirror, lights, network).cell_total);
}

TEST_CASE("Extremes of shine give numbers", "[shine][unit]") {
  const double m = GENERATE(1e-6, 0.032, 1.0, 10.0);
  const double n = GENERATE(1.0001, 100.0);
  Zone zone = room(0.5, 0.5);
  make_glossy(zone, kFloor, 1.0, m, n, 0.0);
  make_glossy(zone, kX0, 1.0, m, n, 0.0);
  const auto solution = solve(zone, point_lamp({-0.7, 0.2, -1.249}, 100.0), network_of(zone, {8, 16}));
  CAPTURE(m, n);
  for (const float e : solution.cell_total) CHECK((std::isfinite(e) && e >= 0.0F));
  CHECK(worst_imbalance(solution) < 2e-2);
}

TEST_CASE("Each saving leaves the answer as the full model has it", "[shine][plan][property]") {
  Zone zone = room(0.6);
  zone.closed = true;
  for (int i = 0; i < 5; ++i) zone.points.push_back({{-1.7 + 0.7 * i, 0.2, -0.5}, {0, 0, 1}});
  Lights lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
  add_lamp(lights, "panel", {0.5, -0.5, 1.2}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(0.6, 0.6)});
  const Network network = network_of(zone);
  SimulationOptions full;
  full.always_test_visibility = true;
  const auto least = solve(zone, lights, network), all = solve(zone, lights, network, full);
  CHECK_FALSE(least.plan.tests_visibility);
  CHECK(all.plan.tests_visibility);
  for (std::size_t s = 0; s < 2; ++s) {
    const auto a = cell_lx(least, s), b = cell_lx(all, s);
    double mean = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      mean += b[i] / static_cast<double>(b.size());
      worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    // Faint pairs are sampled where visibility is tested.
    CHECK(worst < 5e-3 * mean);
    for (std::size_t i = 0; i < zone.points.size(); ++i)
      CHECK(point_lx(least, s)[i] == Approx(point_lx(all, s)[i]).epsilon(2e-3));
  }

  make_glossy(zone, kFloor, 0.4, 0.15, 1.7);
  SimulationOptions shared, apart;
  shared.bands = apart.bands = Bands::uniform(3);
  apart.solve_every_band = true;
  const auto one = solve(zone, lights, network, shared), three = solve(zone, lights, network, apart);
  CHECK(one.plan.n_classes() == 1);
  CHECK(three.plan.n_classes() == 3);
  // Every class of its own is the one that all share, bit by bit. [source, class, ...]
  const auto same_in_each_class = [&](const std::vector<float>& shared_by_all, const std::vector<float>& each) {
    REQUIRE(each.size() == 3 * shared_by_all.size());
    const std::size_t n = shared_by_all.size() / 2;
    for (std::size_t at = 0; at < each.size(); ++at)
      if (each[at] != shared_by_all[at / (3 * n) * n + at % n]) return false;
    return true;
  };
  CHECK(same_in_each_class(one.cell_total, three.cell_total));
  CHECK(same_in_each_class(one.directional.total, three.directional.total));

  // Something in the way is not overlooked.
  add_box(zone, "block", {0, 0, -1.25}, {0.5, 0.5, -0.5}, 0, 0.25, true);
  CHECK(solve(zone, lights, network_of(zone)).plan.tests_visibility);
}

TEST_CASE("Shine gives the same bits on any number of threads", "[shine][property]") {
  const auto run = [](std::size_t n_threads, Solver solver) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n_threads);
    Zone zone = room(0.5, 0.4);
    make_glossy(zone, kFloor, 0.5, 0.2, 2.0);
    make_mirror(zone, kX0, 0.9);
    zone.points.push_back({{0.2, 0.2, -0.5}, {0, 0, 1}});
    Lights lights = point_lamp({-0.7, 0.2, 0.6}, 100.0);
    add_lamp(lights, "panel", {0.5, -0.5, 1.2}, IntensityTable::lambertian(100.0),
             {.opening = rectangle(0.6, 0.6)});
    SimulationOptions options;
    options.solver = solver;
    return solve(zone, lights, network_of(zone, {8, 16}), options);
  };
  for (const auto solver : {Solver::gather, Solver::track}) {
    const auto one = run(1, solver), many = run(4, solver);
    CHECK(one.cell_total == many.cell_total);
    CHECK(one.point_total == many.point_total);
    CHECK(one.directional.total == many.directional.total);
  }
}
