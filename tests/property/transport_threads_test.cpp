// The same bits on any number of threads.
#include <tbb/global_control.h>

#include <algorithm>

#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

struct Run {
  DirectLight direct;
  Network network;
  Solution solution;
  std::vector<FirstFlight> flights;
};

Run run_with(std::size_t n_threads, bool family) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n_threads);
  Zone zone = furnished_room(0.6, 0.5);
  zone.surfaces.erase(zone.surfaces.begin() + 1);
  for (int i = 0; i < 20; ++i) zone.points.push_back({{-2.5 + 0.25 * i, 0.3, -0.5}, {0, 0, 1}});
  Lights lights = point_lamp({-1.5, 0.5, 1}, 100.0);
  for (int i = 0; i < 3; ++i)
    add_lamp(lights, "panel" + std::to_string(i), {-1.0 + i, -0.5, 1.3}, IntensityTable::lambertian(100.0),
             {.opening = rectangle(0.6, 0.6), .body = i == 1});
  NetworkOptions options;
  options.patches = {4, 9};
  options.point_patches = {8, 16};
  options.family = family;
  Run run;
  run.direct = test::direct(zone, lights);
  run.network = build_network(zone, Cells(zone), options, Job{});
  run.solution = solve(zone, lights, run.network);
  run.flights = flights_of(zone, lights, 2048);
  return run;
}

}  // namespace

TEST_CASE("One thread and several give the same bits", "[transport][unit]") {
  const bool family = GENERATE(false, true);
  const Run one = run_with(1, family);
  for (const std::size_t n_threads : {2U, 4U}) {
    const Run many = run_with(n_threads, family);
    CHECK(many.direct.cell_lx == one.direct.cell_lx);
    CHECK(many.direct.point_lx == one.direct.point_lx);
    CHECK(std::equal(many.network.sinks.narrow().begin(), many.network.sinks.narrow().end(),
                     one.network.sinks.narrow().begin(), one.network.sinks.narrow().end()));
    CHECK(many.network.row_scale == one.network.row_scale);
    CHECK(many.network.column_scale == one.network.column_scale);
    CHECK(many.network.imbalance == one.network.imbalance);
    CHECK(many.network.n_escaped_rays == one.network.n_escaped_rays);
    CHECK(many.network.extra.cell == one.network.extra.cell);
    CHECK(many.network.extra.weight == one.network.extra.weight);
    CHECK(many.solution.cell_total == one.solution.cell_total);
    CHECK(many.solution.point_total == one.solution.point_total);
    for (std::size_t s = 0; s < one.solution.sources.size(); ++s) {
      CHECK(many.solution.sources[s].energy[0].absorbed_W == one.solution.sources[s].energy[0].absorbed_W);
      CHECK(many.solution.sources[s].residual == one.solution.sources[s].residual);
      CHECK(many.flights[s].escaped == one.flights[s].escaped);
    }
  }
}
