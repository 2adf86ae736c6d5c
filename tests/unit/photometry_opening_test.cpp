#include <cmath>

#include "catch.hpp"
#include "photometry/opening.hpp"

namespace {

using dim::LuminousOpening;
using dim::OpeningShape;

void check_opening(const LuminousOpening& o, OpeningShape shape, double length, double width, double height) {
  CHECK(o.shape == shape);
  CHECK(o.length_m == Approx(length));
  CHECK(o.width_m == Approx(width));
  CHECK(o.height_m == Approx(height));
}

}  // namespace

TEST_CASE("LM-63-2002 signs of width, length and height give the shape", "[photometry][unit]") {
  const auto from = [](double w, double l, double h) { return dim::opening_from_lm63(w, l, h, 2002); };
  check_opening(from(0, 0, 0), OpeningShape::kPoint, 0, 0, 0);
  check_opening(from(0.6, 1.2, 0), OpeningShape::kRectangle, 1.2, 0.6, 0);
  check_opening(from(0.6, 1.2, 0.1), OpeningShape::kBox, 1.2, 0.6, 0.1);
  check_opening(from(0, 1.2, 0), OpeningShape::kLine, 1.2, 0, 0);
  check_opening(from(-0.2, -0.2, 0), OpeningShape::kEllipse, 0.2, 0.2, 0);
  check_opening(from(-0.2, -0.4, 0), OpeningShape::kEllipse, 0.4, 0.2, 0);
  check_opening(from(-0.2, -0.2, 0.3), OpeningShape::kVerticalCylinder, 0.2, 0.2, 0.3);
  check_opening(from(-0.2, -0.2, -0.2), OpeningShape::kEllipsoid, 0.2, 0.2, 0.2);
  check_opening(from(-0.1, 1.2, -0.1), OpeningShape::kHorizontalCylinder, 1.2, 0.1, 0.1);
  check_opening(from(1.2, -0.1, -0.1), OpeningShape::kHorizontalCylinder, 0.1, 1.2, 0.1);
  check_opening(from(-0.2, 0, -0.3), OpeningShape::kVerticalEllipse, 0, 0.2, 0.3);
}

TEST_CASE("LM-63-1995 gives the diameter of a round opening once", "[photometry][unit]") {
  const auto from = [](double w, double l, double h) { return dim::opening_from_lm63(w, l, h, 1995); };
  check_opening(from(-0.2, 0, 0), OpeningShape::kEllipse, 0.2, 0.2, 0);
  check_opening(from(-0.2, 0, 0.3), OpeningShape::kVerticalCylinder, 0.2, 0.2, 0.3);
  check_opening(from(-0.2, 0, -0.2), OpeningShape::kEllipsoid, 0.2, 0.2, 0.2);
  check_opening(from(0, 1.2, -0.1), OpeningShape::kHorizontalCylinder, 1.2, 0.1, 0.1);
  check_opening(from(1.2, 0, -0.1), OpeningShape::kHorizontalCylinder, 0.1, 1.2, 0.1);
  check_opening(from(-0.2, 0.4, 0.1), OpeningShape::kEllipse, 0.4, 0.2, 0.1);
  check_opening(from(-0.2, 0.4, -0.1), OpeningShape::kEllipsoid, 0.4, 0.2, 0.1);
}

TEST_CASE("Samples of a rectangle lie length along x and width along y", "[photometry][unit]") {
  const LuminousOpening o{OpeningShape::kRectangle, 1.2, 0.6, 0.0};
  const auto points = dim::sample_grid(o, 2, 1);
  REQUIRE(points.size() == 2);
  CHECK(points[0].x == Approx(-0.3));
  CHECK(points[1].x == Approx(0.3));
  CHECK(points[0].y == Approx(0.0).margin(1e-15));
  CHECK(dim::area_m2(o) == Approx(0.72));
  CHECK(dim::largest_dimension_m(o) == 1.2);
}

TEST_CASE("Samples of a disc have its area's second moment and stay inside", "[photometry][unit]") {
  const LuminousOpening o{OpeningShape::kEllipse, 0.4, 0.2, 0.0};
  double xx = 0.0;
  double yy = 0.0;
  const auto points = dim::sample_grid(o, 200, 200);
  for (const auto& p : points) {
    REQUIRE((p.x / 0.2) * (p.x / 0.2) + (p.y / 0.1) * (p.y / 0.1) < 1.0);
    xx += p.x * p.x;
    yy += p.y * p.y;
  }
  // Mean of x^2 over an ellipse of semi-axis a is a^2 / 4.
  CHECK(xx / 40000 == Approx(0.2 * 0.2 / 4).epsilon(1e-4));
  CHECK(yy / 40000 == Approx(0.1 * 0.1 / 4).epsilon(1e-4));
  CHECK(dim::area_m2(o) == Approx(dim::kPi * 0.2 * 0.1));
}

TEST_CASE("A point has one sample and a line has them along itself", "[photometry][unit]") {
  CHECK(dim::sample_grid({}, 5, 7).size() == 1);
  const LuminousOpening line{OpeningShape::kLine, 0.0, 1.0, 0.0};
  const auto points = dim::sample_grid(line, 4, 1);
  REQUIRE(points.size() == 4);
  CHECK(points[0].y == Approx(-0.375));
  CHECK(points[0].x == 0.0);
  CHECK(dim::area_m2(line) == 0.0);
  CHECK(dim::largest_dimension_m(line) == 1.0);
}

TEST_CASE("A vertical ellipse is sampled in the plane of C90 and the vertical", "[photometry][unit]") {
  const LuminousOpening o{OpeningShape::kVerticalEllipse, 0.0, 0.2, 0.4};
  for (const auto& p : dim::sample_grid(o, 5, 5)) CHECK(p.x == 0.0);
  CHECK(dim::sample(o, {0.5, 0.999999}).z == Approx(0.2).epsilon(1e-4));
  CHECK(dim::area_m2(o) == Approx(dim::kPi * 0.1 * 0.2));
}
