// What a solution says of its own error, and refining within a time.
#include <cmath>

#include "catch.hpp"
#include "network/point_places.hpp"
#include "property/transport_support.hpp"
#include "result/to_accuracy.hpp"

using namespace dim;
using namespace dim::test;

namespace {

RaysFile coarse_room() {
  RaysFile rays;
  rays.zone = box_zone({4, 3, 2.5}, 0.5, 1.0);
  for (int i = 0; i < 12; ++i)
    rays.zone.points.push_back({{-1.5 + 0.25 * i, 0.1 * (i % 3), -0.4}, {0, 0, 1}});
  rays.zone.point_sets.push_back({"plane", 0, rays.zone.points.size(), {}});
  rays.cells = Cells(rays.zone);
  rays.network = build_network(rays.zone, rays.cells, {.patches = {4, 8}, .point_patches = {8, 16}}, Job{});
  judge_points(rays.network, rays.zone);
  return rays;
}

// Seconds that pass by one at every look.
struct Ticks {
  double now_s = 0.0;
  TimeBudget budget(double seconds) {
    return {seconds, [this] { return now_s += 1.0; }};
  }
};

}  // namespace

TEST_CASE("Surfaces of a cube state errors that hold", "[accuracy][unit]") {
  // All faces of a cube round a lamp are lit alike: E = flux / (6 a^2 (1 - rho)).
  const double rho = GENERATE(0.2, 0.8), a = 2.0;
  const Zone zone = box_zone({a, a, a}, rho, 0.25);
  const Lights lights = point_lamp({0, 0, 0}, 100.0);
  const auto solution = solve(zone, lights, network_of(zone, {8, 16}));
  const LuminanceDatabase database(zone, Cells(zone), lights, solution);
  const double exact = 4 * kPi * 100.0 / (6 * a * a * (1 - rho));
  const Mix mix{1.0};
  const auto figures = surface_figures(database.cells(), cell_appearance(database, database.cells(), mix));
  const auto errors = surface_errors(database, mix, figures);
  REQUIRE(errors);
  REQUIRE(errors->size() == 6);
  for (std::size_t s = 0; s < 6; ++s) {
    CHECK(std::abs(figures[s].illuminance_mean_lx - exact) <= (*errors)[s].total_lx() + 1e-6 * exact);
    CHECK((*errors)[s].total_lx() < 0.05 * exact);
  }
}

TEST_CASE("Errors of surfaces mix as light does", "[accuracy][unit]") {
  const Zone zone = box_zone({4, 3, 2.5}, 0.5, 0.5);
  Lights lights = point_lamp({1, 0.5, 0.3}, 100.0);
  add_lamp(lights, "other", {-1, -0.5, 0.6}, IntensityTable::lambertian(80.0));
  const auto solution = solve(zone, lights, network_of(zone, {8, 16}));
  const LuminanceDatabase database(zone, Cells(zone), lights, solution);
  const std::vector<SurfaceFigures> figures(zone.surfaces.size());
  const auto once = surface_errors(database, {1.0, 0.0}, figures), twice = surface_errors(database, {2.0, 0.0}, figures);
  for (std::size_t s = 0; s < figures.size(); ++s) CHECK((*twice)[s].cells_lx == Approx(2.0 * (*once)[s].cells_lx));
}

TEST_CASE("Without time nothing is refined", "[accuracy][unit]") {
  RaysFile rays = coarse_room();
  SimulationOptions options;
  Ticks ticks;
  const auto result = refine_within(rays, point_lamp({1, 0.5, 0.6}, 100.0), options, ticks.budget(2.0), Job{});
  CHECK(result.n_networks == 0);
  CHECK(result.stated > 0.0);
  CHECK(rays.network.patches == PatchGrid{4, 8});
}

TEST_CASE("More time states less error", "[accuracy][unit]") {
  const Lights lights = point_lamp({1, 0.5, 0.6}, 100.0);
  double before = 1.0;
  int n_before = -1;
  for (const double seconds : {2.0, 16.0, 30.0}) {
    RaysFile rays = coarse_room();
    SimulationOptions options;
    Ticks ticks;
    const auto result = refine_within(rays, lights, options, ticks.budget(seconds), Job{});
    CHECK(result.stated < before);
    CHECK(result.n_networks > n_before);
    before = result.stated;
    n_before = result.n_networks;
  }
}

TEST_CASE("An odd number of sectors does not state more error than an even one", "[accuracy][unit]") {
  const Lights lights = point_lamp({1, 0.5, 0.6}, 100.0);
  // Largest share of points, by the rays of the cells that they see.
  const auto stated = [&](int n_sectors) {
    const RaysFile rays = coarse_room();
    const auto solution = solve(rays.zone, lights, network_of(rays.zone, {16, n_sectors}));
    const LuminanceDatabase database(rays.zone, rays.cells, lights, solution);
    const auto errors = point_errors(database, {1.0});
    const auto lx = point_illuminance_lx(database, {1.0});
    double most = 0.0;
    for (std::size_t p = 0; p < lx.size(); ++p) most = std::max(most, (*errors)[p].cell_rays_lx / lx[p]);
    return most;
  };
  const double even = std::max(stated(32), stated(34));
  CHECK(stated(33) < 3.0 * even);
  CHECK(stated(31) < 3.0 * even);
}
