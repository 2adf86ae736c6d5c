#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "image/contour_drawing.hpp"
#include "image/contour_labels.hpp"
#include "image/contour_levels.hpp"
#include "image/contour_lines.hpp"

using namespace dim;

namespace {

template <class Function>
ValueGrid sampled(int nu, int nv, const Vec2& size_m, Function&& f) {
  ValueGrid grid{nu, nv, size_m, {}};
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      grid.values.push_back(f(Vec2((i + 0.5) * size_m.x / nu, (j + 0.5) * size_m.y / nv)));
  return grid;
}

/// Illuminance under a source of 1000 cd in all directions, 2 m above (2.1, 1.7).
const Vec2 kFoot(2.1, 1.7);
constexpr double kHeight_m = 2.0, kIntensity_cd = 1000.0;
double point_source_lx(const Vec2& p) {
  const double r2 = glm::dot(p - kFoot, p - kFoot) + kHeight_m * kHeight_m;
  return kIntensity_cd * kHeight_m / (r2 * std::sqrt(r2));
}
/// Radius of the circle on which that is `lx`.
double radius_m(double lx) {
  return std::sqrt(std::pow(kIntensity_cd * kHeight_m / lx, 2.0 / 3.0) - kHeight_m * kHeight_m);
}

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double s = cross(b - a, c - a), t = cross(b - a, d - a), u = cross(d - c, a - c),
               v = cross(d - c, b - c);
  return s * t < 0.0 && u * v < 0.0;
}

std::vector<std::pair<Vec2, Vec2>> segments(const std::vector<Isoline>& lines) {
  std::vector<std::pair<Vec2, Vec2>> result;
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.points.size() + (line.closed ? 1 : 0); ++i)
      result.emplace_back(line.points[i - 1], line.points[i % line.points.size()]);
  return result;
}

bool on_edge(const Vec2& p, const Vec2& size) {
  constexpr double kSlack = 1e-12;
  return p.x < kSlack || p.y < kSlack || p.x > size.x - kSlack || p.y > size.y - kSlack;
}

}  // namespace

TEST_CASE("Isolines under a point source are its circles within half a pixel of 1000", "[contour][unit]") {
  const Vec2 size(6.0, 4.0);
  const double px = size.x / 1000.0;
  for (const double spacing : {0.1, 0.2}) {
    const int nu = static_cast<int>(size.x / spacing + 0.5), nv = static_cast<int>(size.y / spacing + 0.5);
    const Lattice field = smooth_field(sampled(nu, nv, size, point_source_lx), 3.0 * px);
    for (const double level : {50.0, 75.0, 100.0, 150.0, 200.0, 240.0}) {
      double worst = 0.0;
      const auto lines = isolines(field, level);
      REQUIRE_FALSE(lines.empty());
      for (const auto& line : lines)
        for (const Vec2& p : line.points)
          worst = std::max(worst, std::abs(glm::length(p - kFoot) - radius_m(level)));
      CAPTURE(spacing, level, worst / px);
      CHECK(worst < 0.5 * px);
    }
  }
}

TEST_CASE("Areas between isolines of a point source are right to 0.5 %", "[contour][unit]") {
  const Lattice field = smooth_field(sampled(24, 16, {6.0, 4.0}, point_source_lx), 0.02);
  double outer = area(region_above(field, 135.0)), outer_exact = kPi * std::pow(radius_m(135.0), 2);
  REQUIRE(isolines(field, 135.0).front().closed);
  for (const double level : {150.0, 175.0, 200.0, 225.0}) {
    const double inner = area(region_above(field, level)), inner_exact = kPi * std::pow(radius_m(level), 2);
    CHECK(outer - inner == Approx(outer_exact - inner_exact).epsilon(0.005));
    outer = inner;
    outer_exact = inner_exact;
  }
}

TEST_CASE("A constant field has no isolines and no levels", "[contour][unit]") {
  const Lattice field = smooth_field(sampled(7, 5, {3.0, 2.0}, [](const Vec2&) { return 300.0; }), 0.01);
  for (const double level : {299.9, 300.0, 300.1}) CHECK(isolines(field, level).empty());
  CHECK(area(region_above(field, 300.0)) == Approx(6.0).epsilon(1e-12));
  CHECK(customary_levels(300.0, 300.0).empty());
  CHECK(customary_levels(300.0, 300.0 * (1.0 + 1e-12)).empty());
}

TEST_CASE("A field of one point is constant, one of one row is constant across", "[contour][unit]") {
  const Lattice one = smooth_field(sampled(1, 1, {2.0, 1.0}, [](const Vec2&) { return 5.0; }), 0.1);
  CHECK(std::all_of(one.values.begin(), one.values.end(), [](double v) { return v == 5.0; }));
  const Lattice row =
      smooth_field(sampled(8, 1, {4.0, 1.0}, [](const Vec2& p) { return 100.0 * p.x; }), 0.05);
  const auto lines = isolines(row, 123.0);
  REQUIRE(lines.size() == 1);
  for (const Vec2& p : lines.front().points) CHECK(p.x == Approx(1.23).epsilon(1e-9));
}

TEST_CASE("Planes and parabolas come out exactly, up to the edge", "[contour][unit]") {
  const auto plane = [](const Vec2& p) { return 200.0 + 30.0 * p.x - 20.0 * p.y; };
  const auto bowl = [](const Vec2& p) { return 100.0 + 40.0 * p.x * p.x + 25.0 * p.y * p.y; };
  const auto check = [](const Lattice& field, const auto& exact) {
    for (int j = 0; j < field.ny; ++j)
      for (int i = 0; i < field.nx; ++i)
        CHECK(field.at(i, j) == Approx(exact(field.place(i, j))).epsilon(1e-12));
  };
  check(smooth_field(sampled(6, 9, {3.0, 3.0}, plane), 0.1), plane);
  check(smooth_field(sampled(6, 9, {3.0, 3.0}, bowl), 0.1), bowl);
}

TEST_CASE("A smooth field overshoots nowhere beside a shadow's edge", "[contour][unit]") {
  const Lattice field = smooth_field(
      sampled(12, 12, {6.0, 6.0}, [](const Vec2& p) { return p.x + 0.4 * p.y < 4.0 ? 500.0 : 80.0; }), 0.05);
  const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
  CHECK(*low >= 80.0 - 1e-9);
  CHECK(*high <= 500.0 + 1e-9);
}

TEST_CASE("Isolines of rough fields are closed or end at the edge and never cross", "[contour][unit]") {
  const Vec2 size(5.0, 4.0);
  std::mt19937_64 random(11);
  for (int round = 0; round < 20; ++round) {
    std::uniform_real_distribution<double> value(0.0, 100.0);
    const Lattice field = smooth_field(sampled(5, 4, size, [&](const Vec2&) { return value(random); }), 0.25);
    std::vector<std::pair<Vec2, Vec2>> all;
    for (const double level : {20.0, 35.0, 50.0, 65.0}) {
      const auto lines = isolines(field, level);
      for (const auto& line : lines) {
        if (line.closed) continue;
        CHECK(on_edge(line.points.front(), size));
        CHECK(on_edge(line.points.back(), size));
      }
      const auto more = segments(lines);
      all.insert(all.end(), more.begin(), more.end());
    }
    int crossings = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        crossings += crosses(all[i].first, all[i].second, all[j].first, all[j].second);
    CHECK(crossings == 0);
  }
}

TEST_CASE("What is above a level lies to the left of its isolines, and its area is theirs",
          "[contour][unit]") {
  const Lattice field = smooth_field(
      sampled(20, 20, {2.0, 2.0}, [](const Vec2& p) { return std::sin(3.0 * p.x) * std::cos(4.0 * p.y); }),
      0.02);
  const double step = 0.02;
  for (const double level : {-0.5, 0.0, 0.4}) {
    double counted = 0.0;
    for (double y = step / 2; y < 2.0; y += step)
      for (double x = step / 2; x < 2.0; x += step)
        counted += std::sin(3.0 * x) * std::cos(4.0 * y) >= level ? step * step : 0.0;
    CHECK(area(region_above(field, level)) == Approx(counted).margin(0.02));
    for (const auto& line : isolines(field, level)) {
      const Vec2 a = line.points[0], b = line.points[1], middle = 0.5 * (a + b);
      const Vec2 left = middle + 0.02 * glm::normalize(Vec2(a.y - b.y, b.x - a.x));
      CHECK(std::sin(3.0 * left.x) * std::cos(4.0 * left.y) >= level - 0.005);
    }
  }
}

TEST_CASE("Lines are cut at a region's edge and whole within it", "[contour][unit]") {
  const Isoline square{{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, true};
  const Region2 all = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  CHECK(clipped(square, all).front().closed);
  const auto parts = clipped(square, {{{2, 0}, {4, 0}, {4, 4}, {2, 4}}});
  REQUIRE(parts.size() == 1);
  CHECK_FALSE(parts[0].closed);
  CHECK(parts[0].points == std::vector<Vec2>{{2, 1}, {3, 1}, {3, 3}, {2, 3}});
  const Region2 left = {{{0, 0}, {2, 0}, {2, 4}, {0, 4}}};
  const auto other = clipped(square, left);
  REQUIRE(other.size() == 1);
  CHECK(other[0].points == std::vector<Vec2>{{2, 3}, {1, 3}, {1, 1}, {2, 1}});
  CHECK(clipped(square, {{{5, 5}, {6, 5}, {6, 6}}}).empty());
}

TEST_CASE("Levels are of the customary series", "[contour][unit]") {
  CHECK(customary_levels(90.0, 1200.0) == std::vector<double>{100, 150, 200, 300, 500, 750, 1000});
  CHECK(customary_levels(0.0, 700.0).back() == 500.0);
  CHECK(customary_levels(0.0, 700.0).front() == 7.5);
  CHECK(customary_levels(0.0, 700.0).size() <= 12);
  CHECK(customary_levels(0.4, 9.0) == std::vector<double>{0.5, 0.75, 1, 1.5, 2, 3, 5, 7.5});
  CHECK(customary_levels(480.0, 520.0) == std::vector<double>{485, 490, 495, 500, 505, 510, 515});
  CHECK(customary_levels(500.0, 1000.0).front() > 500.0);
  CHECK(customary_levels(500.0, 1000.0).back() < 1000.0);
}

TEST_CASE("Labels stand on their lines, within the plan and clear of each other", "[contour][unit]") {
  std::vector<LabelledLine> lines;
  for (int ring = 1; ring <= 6; ++ring) {
    LabelledLine line{{}, true, "1000"};
    for (int k = 0; k < 120; ++k) {
      const double turn = 2.0 * kPi * k / 120;
      line.points.push_back(Vec2(400, 300) + 45.0 * ring * Vec2(std::cos(turn), std::sin(turn)));
    }
    lines.push_back(line);
  }
  Drawing drawing;
  const LabelBox within{{0, 0}, {800, 600}};
  const auto boxes = draw_labelled(lines, within, 14, 1.5, {}, drawing);
  REQUIRE(boxes.size() >= lines.size());
  REQUIRE(drawing.texts.size() == boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    CHECK(boxes[i].low.x >= within.low.x);
    CHECK(boxes[i].high.y <= within.high.y);
    const double radius = glm::length(0.5 * (boxes[i].low + boxes[i].high) - Vec2(400, 300));
    CHECK(std::abs(radius / 45.0 - std::round(radius / 45.0)) < 0.03);
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(boxes[i].overlaps(boxes[j]));
    for (const auto& line : drawing.lines)
      for (const Vec2& p : line.points)
        CHECK_FALSE((p.x > boxes[i].low.x + 1e-6 && p.x < boxes[i].high.x - 1e-6 &&
                     p.y > boxes[i].low.y + 1e-6 && p.y < boxes[i].high.y - 1e-6));
  }
}

TEST_CASE("Squares without a value are left out of the contours", "[contour][unit]") {
  ContourMap map;
  map.polygon = Polygon(Ring3{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  map.values = sampled(8, 8, {4.0, 4.0}, [](const Vec2& p) { return 100.0 * p.x; });
  for (const int k : {27, 28, 35, 36}) map.values.values[static_cast<std::size_t>(k)] = std::nan("");
  map.levels = {200.0};
  map.filled = true;
  map.plan.frame.origin = Vec3(0.0);
  map.plan.high_m = Vec2(4.0);
  const Drawing drawing = contour_drawing(map);
  REQUIRE(drawing.areas.size() >= 2);
  CHECK(drawing.areas[0].more_outlines.size() == 1);  // the hole in the lowest band
}
