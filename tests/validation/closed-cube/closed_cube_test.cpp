// See README.md beside this file.
#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("Closed cube: total illuminance is 4 pi I over A over 1 - rho at default options",
          "[transport][validation]") {
  const double rho = GENERATE(0.2, 0.5, 0.8);
  const Zone zone = box_zone({4, 4, 4}, rho, 0.25);
  const Cells cells(zone);
  const Solution solution =
      solve(zone, point_lamp({0, 0, 0}, 100.0), build_network(zone, cells, NetworkOptions{}, Job{}));
  const double direct = 400 * kPi / 96.0;
  CHECK(total(cells, cell_direct_lx(solution)) / 96.0 == Approx(direct).epsilon(1e-4));
  CHECK(total(cells, cell_lx(solution)) / 96.0 == Approx(direct / (1 - rho)).epsilon(3e-3));
  const auto& energy = solution.sources[0].energy[0];
  CHECK(std::abs(energy.imbalance) < 2e-3);
  CHECK(energy.absorbed_W == Approx(energy.emitted_W).epsilon(2e-3));
}

TEST_CASE("Closed room of any shape: mean illuminance is flux over A over 1 - rho",
          "[transport][validation]") {
  const double rho = GENERATE(0.3, 0.7);
  const Zone zone = furnished_room(rho, 0.25);
  const Cells cells(zone);
  const Solution solution =
      solve(zone, point_lamp({-0.4, 0.6, 1.0}, 100.0), build_network(zone, cells, NetworkOptions{}, Job{}));
  const double area = area_m2(cells);
  CHECK(total(cells, cell_lx(solution)) / area == Approx(400 * kPi / area / (1 - rho)).epsilon(3e-3));
  CHECK(std::abs(solution.sources[0].energy[0].imbalance) < 2e-3);
}
