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

namespace {

bool is_convex(const Ring2& ring, double slack) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[(i + 1) % ring.size()] - ring[i];
    const Vec2 b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
    if (a.x * b.y - a.y * b.x < -slack) return false;
  }
  return true;
}

bool holds(const Ring2& ring, const Vec2& p, double slack_m) {
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    if (line_through({ring[j], ring[i]}).height(p) < -slack_m) return false;
  }
  return true;
}

struct Random {
  std::mt19937 engine;
  std::uniform_real_distribution<double> unit{0.0, 1.0};
  explicit Random(unsigned seed) : engine(seed) {}
  double operator()() { return unit(engine); }
};

// A star-shaped ring is simple, and concave more often than not.
Polygon star(int n, Random& random) {
  Ring3 ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * (i + 0.6 * random()) / n, radius = 0.3 + 3 * random();
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle), 1.0});
  }
  return Polygon(ring);
}

// Whether the open segment p-q crosses the joint.
bool apart(const Vec2& p, const Vec2& q, const Segment2& joint) { return segments_meet({p, q}, joint); }

}  // namespace

TEST_CASE("Cells are convex, tile the polygon, and are found at every point of theirs",
          "[geometry][property]") {
  for (unsigned round = 0; round < 60; ++round) {
    Random random(round);
    const Polygon polygon = round % 3 ? star(3 + static_cast<int>(round) % 9, random)
                                      : Polygon({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}});
    const Vec2 size = polygon.size_m();
    std::vector<Segment2> joints;
    for (unsigned k = 0; k < round % 12; ++k) {
      const Vec2 a(size.x * random(), size.y * random());
      // Every third along a grid line, some of them off it by next to nothing.
      joints.push_back(k % 3
                           ? Segment2{a, {size.x * random(), size.y * random()}}
                           : Segment2{{size.x / 4 + 1e-11 * (k % 2), a.y}, {size.x / 4, size.y * random()}});
    }
    const CellGrid grid(polygon, 0.0, std::pair(4, 3), joints);
    INFO("round " << round);
    CHECK(std::abs(sum_of_areas(grid) / polygon.area_m2() - 1.0) < 1e-12);
    std::vector<Ring2> outlines(grid.cells().size());
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      const GridCell& cell = grid.cells()[i];
      grid.outline(i, outlines[i]);
      CHECK(is_convex(outlines[i], 1e-11));
      CHECK(signed_area(outlines[i]) == Approx(cell.area_m2).epsilon(1e-6));
      CHECK(cell.area_m2 > 0.0);
      CHECK(holds(outlines[i], cell.centroid, 0.0));
      CHECK(grid.cell_at(cell.centroid) == static_cast<int>(i));
      for (const auto& joint : joints) {
        for (const auto& corner : outlines[i])
          CHECK_FALSE(apart(cell.centroid, cell.centroid + 0.999999 * (corner - cell.centroid), joint));
      }
    }
    for (int i = 0; i < 300; ++i) {
      const Vec2 p(size.x * random(), size.y * random());
      if (!polygon.contains(p)) continue;
      const auto cell = static_cast<std::size_t>(grid.cell_at(p));
      REQUIRE(cell < outlines.size());
      CHECK(holds(outlines[cell], p, 1e-7));
    }
  }
}

TEST_CASE("A joint halves the squares that it passes through and no others", "[geometry][unit]") {
  const Polygon floor({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  const std::vector<Segment2> wall = {{{2.8, 0}, {2.8, 3}}};
  const CellGrid grid(floor, 0.5, {}, wall);
  CHECK(grid.cells().size() == 48 + 6);
  CHECK(grid.cell_at({2.79, 1.6}) != grid.cell_at({2.81, 1.6}));
  for (const auto& cell : grid.cells()) {
    CHECK(cell.whole);
    CHECK((cell.high.x <= 2.8 || cell.low.x >= 2.8));
  }
  const std::vector<Segment2> panel = {{{0.7, 0.7}, {1.3, 0.7}}};
  CHECK(CellGrid(floor, 0.5, {}, panel).cells().size() == 48 + 2);
}

TEST_CASE("A joint on a grid line or on another joint splits nothing", "[geometry][unit]") {
  const Polygon floor({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  for (const double off : {0.0, 1e-16, -1e-15, 3e-14}) {
    const std::vector<Segment2> joints = {
        {{2.0 + off, 0}, {2.0, 3}}, {{2.0, 3}, {2.0 - off, 0}}, {{0.1, 1.5 + off}, {3.9, 1.5 - off}}};
    CHECK(CellGrid(floor, 0.5, {}, joints).cells().size() == 48);
  }
}

TEST_CASE("What is too narrow for a cell goes to the side of the joint that it is on", "[geometry][unit]") {
  const Polygon floor({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  for (const double off : {1e-11, -1e-11, 1e-9, -1e-9}) {
    const double x = 2.0 + off;
    const std::vector<Segment2> wall = {{{x, 0}, {x, 3}}};
    const CellGrid grid(floor, 0.5, {}, wall);
    CHECK(grid.cells().size() == 48);
    CHECK(sum_of_areas(grid) == Approx(12).epsilon(1e-13));
    const double between = 2.0 + off / 2, beside = 2.0 + (off > 0 ? -0.1 : 0.1);
    CHECK(grid.cell_at({between, 0.6}) == grid.cell_at({beside, 0.6}));
    CHECK(grid.cell_at({x - 1e-3, 0.6}) != grid.cell_at({x + 1e-3, 0.6}));
    CHECK(grid.cell_at({x - 1e-12, 0.6}) == grid.cell_at({x - 1e-3, 0.6}));
    CHECK(grid.cell_at({x + 1e-12, 0.6}) == grid.cell_at({x + 1e-3, 0.6}));
  }
}

TEST_CASE("Middles of squares are neighbours unless an edge or a joint stands between", "[geometry][unit]") {
  const Polygon room({{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}});
  const std::vector<Segment2> wall = {{{2.4, 0}, {2.4, 1.2}}};
  const CellGrid grid(room, 1.0, {}, wall);
  const auto cell = [&](double x, double y) { return grid.cell_at({x, y}); };
  CHECK(grid.middle_cell(0, 1, 0) == cell(1.5, 0.5));
  CHECK(grid.middle_cell(0, -1, 0) == -1);
  CHECK(grid.middle_cell(grid.square_at({1.5, 2.5}), 1, 0) == -1);  // outside
  CHECK(grid.middle_cell(grid.square_at({1.5, 0.5}), 1, 0) == -1);  // the wall stands on that middle
  CHECK(grid.middle_cell(grid.square_at({1.5, 1.5}), 1, 0) == cell(2.6, 1.5));
  CHECK(grid.middle_cell(grid.square_at({1.5, 1.5}), 0, 1) == cell(1.5, 2.5));
}

TEST_CASE("A floor under thirty thousand small things is divided in little time", "[geometry][unit]") {
  Ring3 outline = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  std::vector<Segment2> joints;
  for (int i = 0; i < 30000; ++i) {
    const Vec2 a(1e-4 * (3 * i + 1), 1.0);
    joints.push_back({a, a + Vec2(0.0, 8.0)});  // slats, all in the same few squares of a coarse grid
  }
  const CellGrid grid(Polygon(outline), 5.0, {}, joints);
  CHECK(grid.cells().size() == 2 * 30000 + 4);
  CHECK(sum_of_areas(grid) == Approx(100.0).epsilon(1e-12));
}
