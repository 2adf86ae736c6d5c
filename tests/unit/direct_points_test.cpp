// Direct light at measuring points against closed forms.
#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// A wide, empty box whose walls are one cell each and in nobody's way.
Zone empty_hall() {
  Zone zone = box_zone({40, 40, 40}, 0.0, 40.0);
  return zone;
}

Ring3 outline(const Luminaire& lamp) {
  const Vec3 a = lamp.c0 * (lamp.opening.length_m / 2.0), b = lamp.c90 * (lamp.opening.width_m / 2.0);
  return {lamp.at - a - b, lamp.at + a - b, lamp.at + a + b, lamp.at - a + b};
}

}  // namespace

TEST_CASE("A point source obeys inverse square and cosine at points of any direction", "[direct][unit]") {
  Zone zone = empty_hall();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(-15.0, 15.0);
  for (int i = 0; i < 200; ++i)
    zone.points.push_back({{within(random), within(random), within(random)},
                           glm::normalize(Vec3(within(random), within(random), within(random)))});
  const Vec3 at(0.3, -0.2, 1.0);
  const auto light = test::direct(zone, point_lamp(at, 250.0));
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const Vec3 d = at - zone.points[i].position;
    const double r = glm::length(d), cosine = std::max(0.0, glm::dot(d, zone.points[i].normal) / r);
    CHECK(light.point_lx[i] == Approx(250.0 * cosine / (r * r)).epsilon(1e-12).margin(1e-15));
  }
}

TEST_CASE("A Lambertian point source adds the cosine at the source", "[direct][unit]") {
  Zone zone = empty_hall();
  for (const double x : {0.0, 0.5, 2.0, 10.0}) zone.points.push_back({{x, 0, -1}, {0, 0, 1}});
  zone.points.push_back({{0, 0, 3}, {0, 0, -1}});  // behind it
  Lights lights;
  add_lamp(lights, "lamp", {0, 0, 1}, IntensityTable::lambertian(100.0));
  const auto light = test::direct(zone, lights);
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = zone.points[i].position.x;
    // I cos(gamma) cos(theta) / r^2 = I h^2 / r^4 with h = 2.
    CHECK(light.point_lx[i] == Approx(100.0 * 4.0 / std::pow(x * x + 4.0, 2)).epsilon(1e-12));
  }
  CHECK(light.point_lx[4] == 0.0);
}

TEST_CASE("A Lambertian rectangle over a point agrees with its configuration factor", "[direct][unit]") {
  // Howell B-4 for a point under a corner, four of them for the middle:
  // F = 1/(2 pi) (X/sqrt(1+X^2) atan(Y/sqrt(1+X^2)) + Y/sqrt(1+Y^2) atan(X/sqrt(1+Y^2))), E = pi L F.
  const double a = 1.2, b = 0.6;
  Zone zone = empty_hall();
  const std::vector<double> heights = {0.06, 0.12, 0.3, 0.6, 1.2, 3.0, 10.0};
  for (const double h : heights) zone.points.push_back({{0, 0, -h}, {0, 0, 1}});
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0}, IntensityTable::lambertian(300.0), {.opening = rectangle(a, b)});
  const auto light = test::direct(zone, lights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double x = a / 2 / heights[i], y = b / 2 / heights[i];
    const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    const double corner = (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
    // Two Gauss points an axis on parts of at most 0.6 of their distance: below 1e-3, see direct.cpp.
    CHECK(light.point_lx[i] == Approx(kPi * 300.0 / (a * b) * 4 * corner).epsilon(1e-3));
  }
}

TEST_CASE("A Lambertian rectangle agrees with Lambert's formula for any place and direction",
          "[direct][unit]") {
  Zone zone = empty_hall();
  Lights lights;
  const auto lamp = add_lamp(lights, "panel", {0.5, 0.2, 0.1}, IntensityTable::lambertian(80.0),
                             {.aim = {0.3, -0.2, -1}, .opening = rectangle(1.0, 0.4)});
  const Ring3 ring = outline(lamp);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  std::vector<double> expected;
  while (expected.size() < 300) {
    const Vec3 p = lamp.at + 3.0 * Vec3(within(random), within(random), within(random));
    const Vec3 n = glm::normalize(Vec3(within(random), within(random), within(random)));
    bool above = glm::dot(p - lamp.at, lamp.aim) > 0.1;  // a tenth of its longer side in front of it
    for (const auto& corner : ring) above = above && glm::dot(corner - p, n) > 0.0;
    if (!above) continue;
    zone.points.push_back({p, n});
    expected.push_back(lambert_lx(p, n, ring, 80.0 / 0.4));
  }
  const auto light = test::direct(zone, lights);
  double brightest = 0.0;
  for (const double lx : expected) brightest = std::max(brightest, lx);
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(light.point_lx[i] == Approx(expected[i]).epsilon(5e-3).margin(1e-4 * brightest));
}

TEST_CASE("A disc on its axis gives I over R squared plus h squared", "[direct][unit]") {
  const double radius = 0.3;
  Zone zone = empty_hall();
  // Down to a tenth of its diameter.
  const std::vector<double> heights = {0.06, 0.15, 0.3, 1.0, 5.0};
  for (const double h : heights) zone.points.push_back({{0, 0, -h}, {0, 0, 1}});
  Lights lights;
  add_lamp(lights, "disc", {0, 0, 0}, IntensityTable::lambertian(100.0),
           {.opening = {OpeningShape::kEllipse, 2 * radius, 2 * radius, 0.0}});
  const auto light = test::direct(zone, lights);
  for (std::size_t i = 0; i < heights.size(); ++i)
    CHECK(light.point_lx[i] == Approx(100.0 / (radius * radius + heights[i] * heights[i])).epsilon(5e-3));
}

TEST_CASE("A line source of Lambertian points agrees with its integral", "[direct][unit]") {
  // Facing point at height h under the middle of a line of length l, lumped intensity I cos(gamma):
  // E = I/l int h^2/(x^2+h^2)^2 dx = I/l [x/(2(x^2+h^2)) + atan(x/h)/(2h)] over -l/2..l/2.
  const double l = 1.5;
  Zone zone = empty_hall();
  const std::vector<double> heights = {0.15, 0.5, 2.0};
  for (const double h : heights) zone.points.push_back({{0, 0, -h}, {0, 0, 1}});
  Lights lights;
  add_lamp(lights, "line", {0, 0, 0}, IntensityTable::lambertian(100.0),
           {.opening = {OpeningShape::kLine, l, 0.0, 0.0}});
  const auto light = test::direct(zone, lights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double h = heights[i], x = l / 2;
    const double exact = 100.0 / l * 2 * (x / (2 * (x * x + h * h)) + std::atan(x / h) / (2 * h));
    CHECK(light.point_lx[i] == Approx(exact).epsilon(5e-3));
  }
}

TEST_CASE("A panel that covers the whole sky of a point gives pi times its luminance", "[direct][unit]") {
  // 10 m wide at 5 cm: all but (h/R)^2 = 1e-4 of the hemisphere; the closed form says the rest.
  Zone zone = empty_hall();
  zone.points.push_back({{0, 0, -0.05}, {0, 0, 1}});
  Lights lights;
  const auto lamp = add_lamp(lights, "ceiling", {0, 0, 0}, IntensityTable::lambertian(100.0),
                             {.opening = rectangle(10, 10)});
  const auto light = test::direct(zone, lights);
  CHECK(light.point_lx[0] ==
        Approx(lambert_lx(zone.points[0].position, {0, 0, 1}, outline(lamp), 1.0)).epsilon(5e-3));
  CHECK(light.point_lx[0] == Approx(kPi).epsilon(6e-3));
}

TEST_CASE("A point that sees part of a panel above its horizon gets that part's light", "[direct][unit]") {
  // A vertical panel 2 m high, half of it below the horizon of a point that looks up.
  Zone zone = empty_hall();
  zone.points.push_back({{2, 0, 0}, {0, 0, 1}});
  Lights lights;
  add_lamp(lights, "wall", {0, 0, 0}, IntensityTable::lambertian(100.0),
           {.aim = {1, 0, 0}, .opening = rectangle(2, 2)});
  const auto light = test::direct(zone, lights);
  const Ring3 upper = {{0, -1, 0}, {0, 1, 0}, {0, 1, 1}, {0, -1, 1}};
  // The horizon is found by halving the panel four times: at most 1/32 of its height, where the cosine is
  // that small, is in doubt: (1/32)^2 of the light at worst, but for the share of Gauss points.
  CHECK(light.point_lx[0] == Approx(lambert_lx({2, 0, 0}, {0, 0, 1}, upper, 25.0)).epsilon(5e-3));
}

TEST_CASE("A blocker that hides the whole source leaves exactly nothing", "[direct][unit]") {
  Zone zone = empty_hall();
  add_box(zone, "board.", {-1, -1, -1.1}, {1, 1, -1}, 0, 1.0, true);
  zone.points.push_back({{0, 0, -2}, {0, 0, 1}});
  zone.points.push_back({{0, 0, -0.9}, {0, 0, 1}});
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0}, IntensityTable::lambertian(100.0), {.opening = rectangle(0.6, 0.6)});
  add_lamp(lights, "point", {0.1, 0, 0}, IntensityTable::isotropic(100.0));
  const auto light = test::direct(zone, lights);
  CHECK(light.point_lx[0] == 0.0);
  CHECK(light.point_lx[1] == 0.0);
  CHECK(light.point_lx[2] > 0.0);
  CHECK(light.point_lx[3] == Approx(100.0 * 0.9 / std::pow(0.81 + 0.01, 1.5)).epsilon(1e-12));
}

TEST_CASE("Points behind a half-plane see the closed-form share of a panel", "[direct][unit]") {
  // Source 1 x 1 at z = 0 looking down, half-plane x < 0 at z = -1, points at z = -2: from x the edge is
  // seen at -x in the source's plane, so that x' in (-x, 0.5) is visible.
  Zone zone = empty_hall();
  add_surface(zone, "board", {{-19, -19, -1}, {0, -19, -1}, {0, 19, -1}, {-19, 19, -1}}, 0, 40.0);
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0}, IntensityTable::lambertian(100.0), {.opening = rectangle(1, 1)});
  std::vector<double> expected;
  constexpr int kPoints = 400;
  for (int i = 0; i < kPoints; ++i) {
    const double x = -0.45 + 0.9 * (i + 0.5) / kPoints;
    const Vec3 p(x, 0.0, -2.0);
    zone.points.push_back({p, {0, 0, 1}});
    const double edge = -x;
    expected.push_back(
        lambert_lx(p, {0, 0, 1}, {{edge, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {edge, 0.5, 0}}, 100.0));
  }
  const auto light = test::direct(zone, lights);
  const double open = lambert_lx({0, 0, -2}, {0, 0, 1},
                                 {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, 100.0);
  double sum = 0.0, exact = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    // Four standard deviations of a share counted with 64 random rays, sqrt(1/4/64) = 1/16.
    CHECK(std::abs(light.point_lx[at] - expected[at]) < 4.0 / 16.0 * open);
    sum += light.point_lx[at];
    exact += expected[at];
  }
  // Unbiased: their mean within four standard deviations of the mean of as many, on half the open light.
  CHECK(sum == Approx(exact).epsilon(4.0 / 16.0 / std::sqrt(kPoints) / 0.5));
}
