// View factors against closed forms: J. R. Howell, A Catalog of Radiation Heat Transfer Configuration
// Factors, C-11 (opposed rectangles), C-13 (parallel rectangles anywhere), C-14 (rectangles with a common
// edge at a right angle); symmetry; and the sum over a closed body.
#include "geometry/view_factors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace dim;

namespace {

double c11(double a, double b, double c) {
  const double x = a / c, y = b / c, x2 = 1 + x * x, y2 = 1 + y * y;
  return 2 / (kPi * x * y) *
         (0.5 * std::log(x2 * y2 / (x2 + y2 - 1)) + x * std::sqrt(y2) * std::atan(x / std::sqrt(y2)) +
          y * std::sqrt(x2) * std::atan(y / std::sqrt(x2)) - x * std::atan(x) - y * std::atan(y));
}

// From the rectangle w x l to h x l.
double c14(double w_m, double h_m, double l_m) {
  const double w = w_m / l_m, h = h_m / l_m, w2 = w * w, h2 = h * h, s = w2 + h2;
  return 1 / (kPi * w) *
         (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * (std::log((1 + w2) * (1 + h2) / (1 + s)) + w2 * std::log(w2 * (1 + s) / ((1 + w2) * s)) +
                  h2 * std::log(h2 * (1 + s) / ((1 + h2) * s))));
}

struct Span {
  double low, high;
};

// From x1 x y1 to x2 x y2 a height z above.
double c13(Span x1, Span y1, Span x2, Span y2, double z) {
  const auto g = [z](double dx, double dy) {
    const double p = std::hypot(dx, z), q = std::hypot(dy, z);
    return (dy * p * std::atan(dy / p) + dx * q * std::atan(dx / q) -
            z * z / 2 * std::log(dx * dx + dy * dy + z * z)) /
           (2 * kPi);
  };
  double sum = 0;
  for (int bits = 0; bits < 16; ++bits) {
    const double dx = ((bits & 1) ? x1.high : x1.low) - ((bits & 2) ? x2.high : x2.low);
    const double dy = ((bits & 4) ? y1.high : y1.low) - ((bits & 8) ? y2.high : y2.low);
    const int ones = (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1) + (bits >> 3 & 1);
    sum += (ones % 2 ? -1 : 1) * g(dx, dy);
  }
  return sum / ((x1.high - x1.low) * (y1.high - y1.low));
}

Ring3 level(Span x, Span y, double z, bool up) {
  Ring3 ring = {{x.low, y.low, z}, {x.high, y.low, z}, {x.high, y.high, z}, {x.low, y.high, z}};
  if (!up) std::reverse(ring.begin(), ring.end());
  return ring;
}

// A turn and a shift that leave no coordinate round.
Ring3 turned(Ring3 ring) {
  for (auto& p : ring) {
    const double a = 0.7, b = 0.4;
    const Vec3 q(std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z);
    p = Vec3(q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z) +
        Vec3(0.13, -0.27, 0.41);
  }
  return ring;
}

ViewFactors factors(const std::vector<Polygon>& polygons, double diameter_m = 5.0) {
  std::vector<Plate> plates;
  for (const auto& polygon : polygons) plates.push_back({&polygon});
  return view_factors(plates, diameter_m);
}

// Faces of the convex body with these corners, seen from inside; each face a list of corners in any turn.
std::vector<Polygon> inside_of(const Ring3& corners, const std::vector<std::vector<int>>& faces) {
  Vec3 middle(0.0);
  for (const auto& p : corners) middle += p / static_cast<double>(corners.size());
  std::vector<Polygon> polygons;
  for (const auto& face : faces) {
    Ring3 ring;
    for (const int corner : face) ring.push_back(corners[static_cast<std::size_t>(corner)]);
    if (glm::dot(newell(ring), middle - ring[0]) < 0) std::reverse(ring.begin(), ring.end());
    polygons.emplace_back(ring);
  }
  return polygons;
}

}  // namespace

TEST_CASE("Opposed rectangles have the view factor of Howell C-11", "[geometry][view_factors][validation]") {
  for (const Vec3 abc : {Vec3(1, 1, 1), Vec3(4, 3, 0.25), Vec3(2, 0.2, 1), Vec3(0.1, 0.1, 1),
                         Vec3(0.2, 0.2, 1), Vec3(0.04, 0.04, 1)}) {
    const auto result = factors({Polygon(turned(level({0, abc.x}, {0, abc.y}, 0, true))),
                                 Polygon(turned(level({0, abc.x}, {0, abc.y}, abc.z, false)))});
    const double exact = c11(abc.x, abc.y, abc.z);
    INFO("a b c " << abc.x << ' ' << abc.y << ' ' << abc.z << " exact " << exact);
    CHECK(result.at(0, 1) == Approx(exact).epsilon(1e-6));
    CHECK(result.at(1, 0) == Approx(exact).epsilon(1e-6));
    CHECK(result.escaped[0] == Approx(1 - exact).margin(0.002));
  }
}

TEST_CASE("Rectangles with a common edge have the view factor of Howell C-14",
          "[geometry][view_factors][validation]") {
  for (const Vec3 whl : {Vec3(1, 1, 1), Vec3(3, 0.5, 1), Vec3(0.5, 3, 1), Vec3(1, 0.02, 1), Vec3(5, 0.1, 0.5),
                         Vec3(0.01, 4, 2)}) {
    const auto result =
        factors({Polygon(turned(level({0, whl.x}, {0, whl.z}, 0, true))),
                 Polygon(turned({{0, 0, 0}, {0, whl.z, 0}, {0, whl.z, whl.y}, {0, 0, whl.y}}))});
    const double exact = c14(whl.x, whl.y, whl.z);
    INFO("w h l " << whl.x << ' ' << whl.y << ' ' << whl.z << " exact " << exact);
    CHECK(result.at(0, 1) == Approx(exact).epsilon(1e-6));
    CHECK(result.at(1, 0) == Approx(exact * whl.x / whl.y).epsilon(1e-6));
  }
}

TEST_CASE("Only the part in front of a polygon's plane sees it", "[geometry][view_factors][validation]") {
  // The wall reaches as far below the floor's plane as above it.
  const auto result = factors({Polygon(turned(level({0, 2}, {0, 1}, 0, true))),
                               Polygon(turned({{0, 0, -1.5}, {0, 1, -1.5}, {0, 1, 1.5}, {0, 0, 1.5}}))});
  CHECK(result.at(0, 1) == Approx(c14(2, 1.5, 1)).epsilon(1e-6));
  CHECK(result.at(1, 0) == Approx(c14(2, 1.5, 1) * 2 / 3).epsilon(1e-6));
}

TEST_CASE("A hole in a polygon takes away just its share", "[geometry][view_factors][validation]") {
  const auto result = factors({Polygon(turned(level({0, 3}, {0, 2}, 0, true))),
                               Polygon(turned(level({1, 3}, {0, 1}, 0.8, false)),
                                       {turned(level({1.5, 2.5}, {0.2, 0.9}, 0.8, true))})});
  const double exact =
      c13({0, 3}, {0, 2}, {1, 3}, {0, 1}, 0.8) - c13({0, 3}, {0, 2}, {1.5, 2.5}, {0.2, 0.9}, 0.8);
  CHECK(result.at(0, 1) == Approx(exact).epsilon(1e-6));
}

TEST_CASE("View factors of every face of a convex body add up to one",
          "[geometry][view_factors][validation]") {
  const Ring3 regular = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::vector<std::vector<int>> tetrahedron = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const auto equal = factors(inside_of(regular, tetrahedron));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) CHECK(equal.at(i, j) == Approx(i == j ? 0 : 1.0 / 3).epsilon(1e-6));
  }
  const auto crooked =
      factors(inside_of({{1.2, 0.8, 1.4}, {1, -1.1, -0.9}, {-0.3, 1, -1.2}, {-1, -0.4, 0.2}}, tetrahedron));
  const auto roof = factors(inside_of({{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {0, 3, 0}, {1, 1.7, 2}, {4, 1.7, 2}},
                                      {{0, 1, 2, 3}, {0, 3, 4}, {1, 2, 5}, {0, 1, 5, 4}, {2, 3, 4, 5}}));
  for (const auto* result : {&crooked, &roof}) {
    for (const double sum : result->row_sums) CHECK(sum == Approx(1).epsilon(1e-6));
    for (const double escaped : result->escaped) CHECK(escaped == 0);
  }
}

TEST_CASE("A sheet that covers all leaves nothing, one that covers half leaves half",
          "[geometry][view_factors][validation]") {
  // Mirrored in the middle, a line that the sheet stops becomes one that it lets through.
  for (const double side : {1.0, 0.3, 0.2}) {
    const Polygon floor(turned(level({-side / 2, side / 2}, {0, side}, 0, true)));
    const Polygon ceiling(turned(level({-side / 2, side / 2}, {0, side}, 1, false)));
    const auto full = factors({floor, ceiling, Polygon(turned(level({-3, 3}, {-3, 3}, 0.5, true)))});
    CHECK(full.at(0, 1) == 0);
    const auto half = factors({floor, ceiling, Polygon(turned(level({-3, 0}, {-3, 3}, 0.5, true)))});
    const double exact = c11(side, side, 1) / 2;
    INFO("half hidden " << exact << ": error " << 100 * (half.at(0, 1) / exact - 1) << " %");
    CHECK(half.at(0, 1) == Approx(exact).epsilon(0.005));
  }
}

TEST_CASE("Through a hole in a sheet that lies on a polygon only the part behind the hole is seen",
          "[geometry][view_factors][validation]") {
  for (const Span hole : {Span{0.2, 0.9}, Span{0.4, 0.6}, Span{0.5, 0.6}}) {
    const auto result = factors({Polygon(turned(level({0, 1}, {0, 1}, 0, true))),
                                 Polygon(turned(level({0, 1}, {0, 1}, 1, false))),
                                 Polygon(turned(level({-1, 2}, {-1, 2}, 1 - 1e-7, false)),
                                         {turned(level(hole, hole, 1 - 1e-7, true))})});
    const double exact = c13({0, 1}, {0, 1}, hole, hole, 1);
    INFO("through a hole " << exact << ": error " << 100 * (result.at(0, 1) / exact - 1) << " %");
    CHECK(result.at(0, 1) == Approx(exact).epsilon(0.005));
  }
}

TEST_CASE("A partition that stands on the floor hides the wall behind it",
          "[geometry][view_factors][validation]") {
  // Hottel's crossed strings for a long channel: floor from x = 0 to 0.5, a partition 0.5 high at its edge, a
  // wall 2 high at x = 1. Strings go over the partition's top.
  const double l = 1000;
  const auto result = factors({Polygon(Ring3{{0, 0, 0}, {0.5, 0, 0}, {0.5, l, 0}, {0, l, 0}}),
                               Polygon(Ring3{{1, 0, 0}, {1, 0, 2}, {1, l, 2}, {1, l, 0}}),
                               Polygon(Ring3{{0.5, 0, 0}, {0.5, 0, 0.5}, {0.5, l, 0.5}, {0.5, l, 0}})},
                              l);
  const double top = std::hypot(0.5, 0.5);
  const double crossed = 2 * top + 0.5 + std::hypot(0.5, 1.5), uncrossed = std::hypot(1, 2) + 0.5 + top;
  const double exact = (crossed - uncrossed) / (2 * 0.5);
  INFO("over a partition " << exact << ": error " << 100 * (result.at(0, 1) / exact - 1) << " %");
  CHECK(result.at(0, 1) == Approx(exact).epsilon(0.005));
}
