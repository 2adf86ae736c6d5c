// Direct light of cells: flux against solid angles, nearness, clipped cells, two-sided panels, bodies.
#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// A floor in the open, its first cells those of the test. Far below lies ground so wide that nothing above it
// counts as faint (bringing less than 1 % of the mean), where a few rays would do.
Zone open_floor(const Vec2& lo, const Vec2& hi, int nu, int nv) {
  Zone zone;
  zone.diameter_m = 1500.0;
  add_floor(zone, lo, hi, 0.0, nu, nv);
  add_floor(zone, {-500, -500}, {500, 500}, -50.0, 1, 1);
  return zone;
}

// Flux on the first surface.
double floor_lm(const Zone& zone, const DirectLight& light) {
  const Cells cells(zone);
  double sum = 0.0;
  for (std::size_t i = 0; i < cells.first(1); ++i) sum += cells.area_m2(i) * light.cell_lx[i];
  return sum;
}

}  // namespace

TEST_CASE("A point source sends a rectangle its intensity times the rectangle's solid angle",
          "[direct][unit]") {
  // One cell whatever its size against the distance. Two Gauss points an axis on parts of at most 0.6 of
  // their distance: 1e-3, see direct.cpp.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-4.0, 4.0);
  for (const double height : {10.0, 3.0, 1.0, 0.3, 0.1, 0.01, 0.001}) {
    for (int i = 0; i < 8; ++i) {
      const Vec2 a(within(random), within(random)), b(within(random), within(random));
      const Vec2 lo = glm::min(a, b), hi = glm::max(a, b) + 0.2;
      const Zone zone = open_floor(lo, hi, 1, 1);
      const auto light = test::direct(zone, point_lamp({0, 0, height}, 100.0));
      const double omega = solid_angle_sr(lo, hi, height);
      CAPTURE(height, lo.x, lo.y, hi.x, hi.y);
      CHECK(light.cell_lx[0] * (hi.x - lo.x) * (hi.y - lo.y) == Approx(100.0 * omega).epsilon(2e-3));
    }
  }
}

TEST_CASE("Every cell of a grid gets its own solid angle's flux", "[direct][unit]") {
  const Zone zone = open_floor({-2, -2}, {2, 2}, 16, 16);
  const Cells cells(zone);
  const Vec3 at(0.37, -0.21, 0.5);
  const auto light = test::direct(zone, point_lamp(at, 100.0));
  for (std::size_t i = 0; i < cells.first(1); ++i) {
    const auto& cell = cells[i];
    const Vec3 lo = zone.surfaces[0].polygon.frame().to_world(cell.low),
               hi = zone.surfaces[0].polygon.frame().to_world(cell.high);
    const double omega = solid_angle_sr(glm::min(Vec2(lo), Vec2(hi)) - Vec2(at),
                                        glm::max(Vec2(lo), Vec2(hi)) - Vec2(at), at.z);
    CHECK(light.cell_lx[i] * cell.area_m2 == Approx(100.0 * omega).epsilon(1e-3));
  }
}

TEST_CASE("A source one millimetre from a surface is finite and conserves flux", "[direct][unit]") {
  const auto n = GENERATE(1, 7, 20);
  const Zone zone = open_floor({-1, -1}, {1, 1}, n, n);
  const auto light = test::direct(zone, point_lamp({0.013, 0.021, 1e-3}, 100.0));
  for (const double lx : light.cell_lx) CHECK(std::isfinite(lx));
  const double omega = solid_angle_sr({-1.013, -1.021}, {0.987, 0.979}, 1e-3);
  CHECK(floor_lm(zone, light) == Approx(100.0 * omega).epsilon(5e-3));
}

TEST_CASE("A Lambertian panel's flux on a large floor is its own", "[direct][unit]") {
  // Opposed coaxial squares of sides 0.6 and 12 at 0.5 m: the view factor from the small one by reciprocity
  // from the average of configuration factors; here by Lambert's formula over a fine grid of the panel.
  const Zone zone = open_floor({-6, -6}, {6, 6}, 24, 24);
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0.5}, IntensityTable::lambertian(100.0), {.opening = rectangle(0.6, 0.6)});
  const auto light = test::direct(zone, lights);
  double view_factor = 0.0;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 p(-0.3 + 0.6 * (i + 0.5) / n, -0.3 + 0.6 * (j + 0.5) / n, 0.5);
      view_factor +=
          lambert_lx(p, {0, 0, -1}, {{-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}}, 1.0 / kPi) / (n * n);
    }
  }
  CHECK(floor_lm(zone, light) == Approx(kPi * 100.0 * view_factor).epsilon(2e-3));
}

TEST_CASE("A panel just above a surface shines on it with conserved flux", "[direct][unit]") {
  // 1 mm over a floor three times its size; by symmetry of view factors all but the light that leaves
  // sideways within 1 mm of its edge arrives: less than perimeter x height / area = 0.7 %, half of it inward.
  const double height = GENERATE(0.1, 0.01, 0.001);
  const Zone zone = open_floor({-0.9, -0.9}, {0.9, 0.9}, 9, 9);
  Lights lights;
  add_lamp(lights, "panel", {0.03, 0, height}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(0.6, 0.6)});
  const auto light = test::direct(zone, lights);
  double view_factor = 0.0;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 p(-0.27 + 0.6 * (i + 0.5) / n, -0.3 + 0.6 * (j + 0.5) / n, height);
      const Ring3 ring = {{-0.9, -0.9, 0}, {0.9, -0.9, 0}, {0.9, 0.9, 0}, {-0.9, 0.9, 0}};
      view_factor += lambert_lx(p, {0, 0, -1}, ring, 1.0 / kPi) / (n * n);
    }
  }
  CAPTURE(height);
  CHECK(floor_lm(zone, light) == Approx(kPi * 100.0 * view_factor).epsilon(5e-3));
}

TEST_CASE("A panel that lies in the plane of a surface gives it nothing and does not take forever",
          "[direct][unit]") {
  // Tilted, so that rounding puts corners of cells on either side of the opening's plane.
  Zone zone;
  zone.diameter_m = 10.0;
  const int grey = add_grey(zone, 0.5);
  const Vec3 u = glm::normalize(Vec3(1, 0.2, 0.3)), v = glm::normalize(glm::cross(Vec3(0.1, -0.3, 1), u));
  const Vec3 o(0.1, 0.7, 0.3);
  add_surface(zone, "ceiling", {o - u - v, o + u - v, o + u + v, o - u + v}, grey, 0.25);
  const Vec3 n = zone.surfaces[0].polygon.normal();
  for (const auto& intensity : {IntensityTable::lambertian(10.0), IntensityTable::isotropic(10.0)}) {
    Lights lights;
    auto& lamp =
        add_lamp(lights, "panel", o + 0.11 * u, intensity, {.aim = n, .opening = rectangle(0.6, 0.6)});
    lamp.c0 = u;
    lamp.c90 = glm::cross(lamp.c0, lamp.aim);
    const auto light = test::direct(zone, lights);
    for (const double lx : light.cell_lx) CHECK(std::isfinite(lx));
    if (intensity.zero_behind()) CHECK(floor_lm(zone, light) < 1e-3 * kPi * 10.0);
  }
}

TEST_CASE("Cells clipped to slivers are lit like their neighbours", "[direct][unit]") {
  // A triangle: its long edge cuts squares into parts of every size.
  Zone zone;
  zone.diameter_m = 10.0;
  const int grey = add_grey(zone, 0.5);
  add_surface(zone, "floor", {{-2, -2, 0}, {2, -2, 0}, {-2, 1.37, 0}}, grey, 0.25);
  const Cells cells(zone);
  const Vec3 at(0, 0, 2.0);
  const auto light = test::direct(zone, point_lamp(at, 100.0));
  std::size_t n_clipped = 0;
  double flux_lm = 0.0, exact_lm = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    n_clipped += !cells[i].whole;
    const Vec3 d = at - zone.surfaces[0].polygon.frame().to_world(cells[i].centroid);
    const double at_centroid = 100.0 * d.z / std::pow(glm::length(d), 3);
    flux_lm += cells.area_m2(i) * light.cell_lx[i];
    // Solid angle of the part's fan of triangles would be exact; the centroid is good to (size/r)^2 = 1.5 %.
    exact_lm += cells.area_m2(i) * at_centroid;
    CAPTURE(i, cells[i].area_m2);
    // A clipped cell's value is a mean over chosen points of it: within the spread over its square.
    CHECK(light.cell_lx[i] == Approx(at_centroid).epsilon(cells[i].whole ? 0.015 : 0.2));
  }
  CHECK(n_clipped > 10);
  CHECK(flux_lm == Approx(exact_lm).epsilon(5e-3));
}

TEST_CASE("A two-sided panel is lit on each side by the lamp on that side", "[direct][unit]") {
  Zone zone;
  zone.diameter_m = 10.0;
  const int grey = add_grey(zone, 0.5);
  add_floor(zone, {-1, -1}, {1, 1}, 0.0, 4, 4);
  Surface back = zone.surfaces[0];
  back.name = "floor0.back";
  back.polygon = back.polygon.reversed();
  back.finish = grey;
  zone.surfaces.push_back(back);
  zone.surfaces[0].twin = 1;
  zone.surfaces[1].twin = 0;
  Lights lights = point_lamp({0.1, 0.2, 0.7}, 100.0);
  add_lamp(lights, "below", {0.1, 0.2, -0.7}, IntensityTable::isotropic(50.0));
  const auto light = test::direct(zone, lights);
  const Cells cells(zone);
  const double omega = solid_angle_sr({-1.1, -1.2}, {0.9, 0.8}, 0.7);
  double above_on_top = 0.0, above_below = 0.0, below_on_top = 0.0, below_below = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double a = cells.area_m2(i);
    (cells.surface_of(i) == 0 ? above_on_top : above_below) += a * light.cell_lx[2 * i];
    (cells.surface_of(i) == 0 ? below_on_top : below_below) += a * light.cell_lx[2 * i + 1];
  }
  CHECK(above_on_top == Approx(100.0 * omega).epsilon(1e-3));
  CHECK(below_below == Approx(50.0 * omega).epsilon(1e-3));
  CHECK(above_below == 0.0);
  CHECK(below_on_top == 0.0);
}

TEST_CASE("A luminaire's body stops light from behind and not its own", "[direct][unit]") {
  const Zone zone = open_floor({-0.1, -0.1}, {0.1, 0.1}, 1, 1);
  for (const bool body : {false, true}) {
    Lights lights;
    add_lamp(lights, "low", {0, 0, 1}, IntensityTable::lambertian(100.0),
             {.opening = rectangle(0.5, 0.5), .body = body});
    add_lamp(lights, "high", {0, 0, 2}, IntensityTable::isotropic(100.0));
    const auto light = test::direct(zone, lights);
    const Ring3 panel = {{-0.25, -0.25, 1}, {0.25, -0.25, 1}, {0.25, 0.25, 1}, {-0.25, 0.25, 1}};
    // The floor cell is 0.2 m wide at 1 m: its mean of (1 + r^2)^-2 is 2 * (2/3 * 0.1^2) = 1.3 % below its middle.
    CHECK(light.cell_lx[0] == Approx(lambert_lx({0, 0, 0}, {0, 0, 1}, panel, 400.0)).epsilon(1.5e-2));
    if (body)
      CHECK(light.cell_lx[1] == 0.0);
    else
      CHECK(light.cell_lx[1] ==
            Approx(100.0 * solid_angle_sr({-0.1, -0.1}, {0.1, 0.1}, 2) / 0.04).epsilon(1e-3));
  }
}

TEST_CASE("A narrow beam brings a floor of coarse cells its whole flux", "[direct][unit]") {
  // I = I0 (1 - gamma/10 deg) within 10 degrees: all of it meets the floor, whatever the cells.
  IntensityDistribution beam{{0.0, 2 * kPi}, {0.0, radians(10.0)}, {1000.0, 0.0, 1000.0, 0.0}};
  const IntensityTable table(beam);
  const int n = GENERATE(4, 8, 16, 33);
  const Zone zone = open_floor({-2, -2}, {2, 2}, n, n);
  Lights lights;
  add_lamp(lights, "spot", {0.11, 0.07, 2.0}, table);
  const auto light = test::direct(zone, lights);
  CAPTURE(n);
  CHECK(floor_lm(zone, light) == Approx(table.flux_lm()).epsilon(5e-3));
}

TEST_CASE("Sources are summed into the columns they are given", "[direct][unit]") {
  Zone zone = furnished_room(0.0, 0.8);
  zone.points.push_back({{0, 0, 0}, {0, 0, 1}});
  Lights lights = point_lamp({-2, 0, 1}, 100.0);
  add_lamp(lights, "b", {2, 0, 1}, IntensityTable::isotropic(30.0));
  add_lamp(lights, "c", {0, 1, 1}, IntensityTable::lambertian(70.0), {.opening = rectangle(0.6, 0.3)});
  const Cells cells(zone);
  const auto apart = direct_light(zone, cells, lights, {0, 1, 2}, 3, Job{});
  const auto grouped = direct_light(zone, cells, lights, {1, 0, 1}, 2, Job{});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CHECK(grouped.cell_lx[2 * i + 1] ==
          Approx(apart.cell_lx[3 * i] + apart.cell_lx[3 * i + 2]).epsilon(1e-14));
    CHECK(grouped.cell_lx[2 * i] == apart.cell_lx[3 * i + 1]);
  }
  CHECK(grouped.point_lx[1] == Approx(apart.point_lx[0] + apart.point_lx[2]).epsilon(1e-14));
}
