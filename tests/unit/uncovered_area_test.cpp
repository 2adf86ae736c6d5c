#include "light/uncovered_area.hpp"

#include "catch.hpp"

using namespace dim;

namespace {

ConvexPatch square() {
  ConvexPatch patch;
  for (const Vec2& corner : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2)}) patch.add(corner);
  return patch;
}

Ring2 box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

}  // namespace

TEST_CASE("Half-planes cut a patch exactly", "[light][unit]") {
  ConvexPatch patch = square();
  patch.keep(-1.0, 1.0, 0.0);  // x >= 1
  CHECK(patch.area() == Approx(2.0));
  CHECK(patch.centroid().x == Approx(1.5));
  patch.keep(3.0, -1.0, -1.0);  // x + y <= 3
  CHECK(patch.area() == Approx(1.5));
  patch.keep(-10.0, 1.0, 1.0);
  CHECK(patch.empty());
}

TEST_CASE("Covers hide their union, holes do not", "[light][unit]") {
  CHECK(uncovered_area(square(), {}) == 4.0);
  CHECK(uncovered_area(square(), {{box(3, 0, 4, 2)}}) == Approx(4.0));
  CHECK(uncovered_area(square(), {{box(-1, -1, 3, 3)}}) == Approx(0.0).margin(1e-12));
  // Two that overlap in half of each.
  CHECK(uncovered_area(square(), {{box(0, 0, 1, 2)}, {box(0.5, 0, 1.5, 2)}}) == Approx(1.0).epsilon(0.01));
  // A frame round a hole of a quarter.
  CHECK(uncovered_area(square(), {{box(-1, -1, 3, 3), box(0.5, 0.5, 1.5, 1.5)}}) == Approx(1.0).epsilon(0.01));
}
