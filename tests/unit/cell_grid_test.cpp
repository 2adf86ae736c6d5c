#include "geometry/cell_grid.hpp"

#include <random>

#include "catch.hpp"

using namespace dim;

namespace {
double sum_of_areas(const CellGrid& grid) {
  double sum = 0.0;
  for (const auto& cell : grid.cells()) sum += cell.area_m2;
  return sum;
}
}  // namespace

TEST_CASE("A rectangle is cut into equal squares of at most the size asked for", "[geometry][unit]") {
  const Polygon wall({{0, 0, 0}, {7.2, 0, 0}, {7.2, 0, 2.8}, {0, 0, 2.8}});
  const CellGrid grid(wall, 0.25);
  CHECK(grid.nu() == 29);
  CHECK(grid.nv() == 12);
  CHECK(grid.cells().size() == 29 * 12);
  CHECK(sum_of_areas(grid) == Approx(7.2 * 2.8).epsilon(1e-13));
}

TEST_CASE("A length that is a whole number of cells gets just that many", "[geometry][unit]") {
  CHECK(n_steps(4.8, 0.1) == 48);
  CHECK(n_steps(0.3, 0.1) == 3);
  CHECK(n_steps(0.30001, 0.1) == 4);
  CHECK(n_steps(1e-6, 0.25) == 1);
}

TEST_CASE("Cells of any clipped polygon add up to its area to 1e-12", "[geometry][property]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    // A star-shaped ring is simple, and concave more often than not.
    Ring3 ring;
    const int n = 3 + round % 9;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * kPi * (i + 0.6 * unit(random)) / n, radius = 0.3 + 3 * unit(random);
      ring.push_back({radius * std::cos(angle), radius * std::sin(angle), 1.0});
    }
    const Polygon polygon(ring);
    const CellGrid grid(polygon, 0.05 + unit(random));
    INFO("round " << round);
    CHECK(std::abs(sum_of_areas(grid) / polygon.area_m2() - 1.0) < 1e-12);
    Vec2 moment(0.0);
    for (const auto& cell : grid.cells()) {
      CHECK(cell.area_m2 > 0.0);
      moment += cell.area_m2 * cell.centroid;
    }
    CHECK(glm::length(polygon.frame().to_world(moment / polygon.area_m2()) - polygon.centroid()) < 1e-11);
  }
}

TEST_CASE("Holes are left out of the cells", "[geometry][unit]") {
  const Polygon polygon({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}},
                        {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}});
  const CellGrid grid(polygon, 0.5);
  CHECK(sum_of_areas(grid) == Approx(11).epsilon(1e-13));
  CHECK(grid.cells().size() == 48 - 4);
}

TEST_CASE("Every point of a polygon belongs to a cell whose bounds hold it", "[geometry][property]") {
  const Polygon polygon({{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}});
  const CellGrid grid(polygon, 0.3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p(unit(random) * polygon.size_m().x, unit(random) * polygon.size_m().y);
    const auto cell = static_cast<std::size_t>(grid.cell_at(p));
    REQUIRE(cell < grid.cells().size());
    if (!polygon.contains(p)) continue;
    CHECK(p.x >= grid.cells()[cell].low.x - 1e-12);
    CHECK(p.x <= grid.cells()[cell].high.x + 1e-12);
  }
}

TEST_CASE("A sliver a micrometre wide keeps its area in cells", "[geometry][unit]") {
  const Polygon sliver({{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {0, 1e-6, 0}});
  const CellGrid grid(sliver, 0.25);
  CHECK(grid.cells().size() == 4);
  CHECK(sum_of_areas(grid) == Approx(1e-6).epsilon(1e-12));
}
