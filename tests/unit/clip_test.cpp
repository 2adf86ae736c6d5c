#include "geometry/clip.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"

using namespace dim;

namespace {

Ring2 rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring2 reversed(Ring2 ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

double overlap_1d(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

Region2 turned(const Region2& region, double angle, const Vec2& shift) {
  Region2 result = region;
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& ring : result)
    for (auto& p : ring) p = Vec2(c * p.x - s * p.y, s * p.x + c * p.y) + shift;
  return result;
}

}  // namespace

TEST_CASE("A window cut from a wall leaves an outer ring and a clockwise hole", "[geometry][unit]") {
  const Region2 rest = clip_difference({rectangle(0, 0, 6, 3)}, {rectangle(1, 1, 2.3, 2.1)});
  REQUIRE(rest.size() == 2);
  CHECK(signed_area(rest[0]) * signed_area(rest[1]) < 0);
  CHECK(area(rest) == Approx(18 - 1.3 * 1.1).epsilon(1e-14));
}

TEST_CASE("A door on the wall's foot leaves one ring with every corner exact", "[geometry][unit]") {
  const Region2 rest = clip_difference({rectangle(0, 0, 6, 2.7)}, {rectangle(1.1, 0, 2.3, 2.1)});
  REQUIRE(rest.size() == 1);
  CHECK(rest[0].size() == 8);
  CHECK(signed_area(rest[0]) > 0);
  for (const auto& p : rest[0]) {
    CHECK((p.x == 0.0 || p.x == 1.1 || p.x == 2.3 || p.x == 6.0));
    CHECK((p.y == 0.0 || p.y == 2.1 || p.y == 2.7));
  }
}

TEST_CASE("Cutting all away leaves nothing, cutting nothing leaves all", "[geometry][unit]") {
  const Region2 wall = {rectangle(0, 0, 1.7, 2.9)};
  CHECK(clip_difference(wall, wall).empty());
  CHECK(clip_difference(wall, {rectangle(-1, -1, 4, 4)}).empty());
  CHECK(area(clip_difference(wall, {rectangle(3, 3, 4, 4)})) == area(wall));
  CHECK(clip_difference(wall, {}) == wall);
  CHECK(clip_intersection(wall, {}).empty());
  CHECK(clip_intersection({}, wall).empty());
}

TEST_CASE("A band across cuts a wall in two pieces", "[geometry][unit]") {
  const Region2 rest = clip_difference({rectangle(0, 0, 6, 3)}, {rectangle(-1, 1, 7, 2)});
  REQUIRE(rest.size() == 2);
  CHECK(signed_area(rest[0]) == Approx(6));
  CHECK(signed_area(rest[1]) == Approx(6));
}

TEST_CASE("A region with a hole keeps it, and cutting inside the hole changes nothing", "[geometry][unit]") {
  const Region2 frame = {rectangle(0, 0, 4, 4), reversed(rectangle(1, 1, 3, 3))};
  CHECK(area(frame) == Approx(12));
  CHECK(area(clip_difference(frame, {rectangle(1.5, 1.5, 2, 2)})) == Approx(12).epsilon(1e-14));
  CHECK(area(clip_intersection(frame, {rectangle(0, 0, 2, 4)})) == Approx(6).epsilon(1e-14));
}

TEST_CASE("Two crossing triangles share the hexagon of a star", "[geometry][unit]") {
  // Unit circumradius: each triangle has area 3 sqrt(3)/4, the hexagram's core sqrt(3)/2.
  Region2 up(1), down(1);
  for (int i = 0; i < 3; ++i) {
    const double angle = kPi / 2 + i * 2 * kPi / 3;
    up[0].push_back({std::cos(angle), std::sin(angle)});
    down[0].push_back({-std::cos(angle), -std::sin(angle)});
  }
  CHECK(area(clip_intersection(up, down)) == Approx(std::sqrt(3.0) / 2).epsilon(1e-13));
  CHECK(area(clip_difference(up, down)) == Approx(std::sqrt(3.0) / 4).epsilon(1e-13));
}

TEST_CASE("Random rectangles at any angle: areas are the products of overlaps to 1e-12",
          "[geometry][property]") {
  std::mt19937 random(20240611);
  std::uniform_real_distribution<double> any(-3.0, 3.0), size(0.05, 4.0), angles(0.0, 2 * kPi);
  for (int i = 0; i < 2000; ++i) {
    const double ax = any(random), ay = any(random), aw = size(random), ah = size(random);
    const double bx = any(random), by = any(random), bw = size(random), bh = size(random);
    const double common = overlap_1d(ax, ax + aw, bx, bx + bw) * overlap_1d(ay, ay + ah, by, by + bh);
    const double angle = angles(random);
    const Vec2 shift(any(random), any(random));
    const Region2 a = turned({rectangle(ax, ay, ax + aw, ay + ah)}, angle, shift);
    const Region2 b = turned({rectangle(bx, by, bx + bw, by + bh)}, angle, shift);
    CHECK(std::abs(area(clip_intersection(a, b)) - common) <= 1e-12 * aw * ah);
    CHECK(std::abs(area(clip_difference(a, b)) - (aw * ah - common)) <= 1e-12 * aw * ah);
  }
}

TEST_CASE("Random L-shapes: what is cut and what is left add up to the whole", "[geometry][property]") {
  std::mt19937 random(77);
  std::uniform_real_distribution<double> at(0.2, 0.8), angles(0.0, 2 * kPi), any(-0.5, 0.5);
  const auto l_shape = [&] {
    const double x = at(random), y = at(random);
    return Region2{{{0, 0}, {1, 0}, {1, y}, {x, y}, {x, 1}, {0, 1}}};
  };
  for (int i = 0; i < 2000; ++i) {
    const Region2 a = turned(l_shape(), angles(random), {any(random), any(random)});
    const Region2 b = turned(l_shape(), angles(random), {any(random), any(random)});
    const double common = area(clip_intersection(a, b));
    CHECK(std::abs(area(clip_difference(a, b)) + common - area(a)) < 1e-12);
    CHECK(std::abs(area(clip_difference(b, a)) + common - area(b)) < 1e-12);
    CHECK(std::abs(area(clip_intersection(b, a)) - common) < 1e-12);
  }
}

TEST_CASE("Clipping keeps its accuracy at any scale and far from the origin", "[geometry][unit]") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec2 far(1e3 * scale, -1e3 * scale);
    Region2 a = {rectangle(0, 0, 2, 1)}, b = {rectangle(0.5, 0.25, 1, 0.75)};
    for (auto* region : {&a, &b})
      for (auto& p : (*region)[0]) p = p * scale + far;
    CHECK(area(clip_difference(a, b)) == Approx(1.75 * scale * scale).epsilon(1e-11));
  }
}

TEST_CASE("Snapping joins what nearly touches, so that no sliver is left", "[geometry][unit]") {
  const double off = 1e-9;
  const Region2 wall = {{{0, 0}, {3, 0}, {6, off}, {6, 3}, {0, 3}}};
  const Region2 door = {rectangle(1, off, 5, 2)};
  const Region2 joined = snapped(door, wall, 1e-6);
  const Region2 rest = without_slivers(clip_difference(wall, joined), 1e-6);
  REQUIRE(rest.size() == 1);
  CHECK(area(rest) == Approx(18 - 8).epsilon(1e-8));
  CHECK(without_slivers({rectangle(0, 0, 10, 1e-9)}, 1e-6).empty());
  CHECK(without_slivers({rectangle(0, 0, 10, 1e-3)}, 1e-6).size() == 1);
}
