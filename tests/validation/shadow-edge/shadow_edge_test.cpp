// See README.md beside this file.
#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("Shadow edge: cells get the solid angle of their lit part", "[transport][validation]") {
  const double edge_at = GENERATE(-0.13, 0.0, 0.071);  // of the half-plane, at half height
  Zone zone;
  zone.diameter_m = 20.0;
  add_floor(zone, {-2, -2}, {2, 2}, -1.0, 16, 400);
  add_surface(zone, "board", {{-8, -8, 0}, {edge_at, -8, 0}, {edge_at, 8, 0}, {-8, 8, 0}}, 0, 20.0);
  const Vec3 at(0.05, 0.03, 1.0);
  const auto light = test::direct(zone, point_lamp(at, 100.0));
  const double edge = at.x + 2 * (edge_at - at.x);
  const Cells cells(zone);
  double sum = 0.0, exact_sum = 0.0, whole_sum = 0.0;
  int n_crossed = 0;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    const Frame& frame = zone.surfaces[0].polygon.frame();
    const Vec2 a(frame.to_world(cells[i].low)), b(frame.to_world(cells[i].high));
    const Vec2 lo = glm::min(a, b), hi = glm::max(a, b);
    const auto lx_from = [&](double x) {
      return 100.0 * solid_angle_sr(Vec2(x, lo.y) - Vec2(at), hi - Vec2(at), 2.0) / cells.area_m2(i);
    };
    if (hi.x <= edge) {
      CHECK(light.cell_lx[i] == 0.0);
    } else if (lo.x >= edge) {
      CHECK(light.cell_lx[i] == Approx(lx_from(lo.x)).epsilon(1e-3));
    } else {
      ++n_crossed;
      sum += light.cell_lx[i];
      exact_sum += lx_from(edge);
      whole_sum += lx_from(lo.x);
      CHECK(std::abs(light.cell_lx[i] - lx_from(edge)) < 4.0 / 16.0 * lx_from(lo.x));
    }
  }
  REQUIRE(n_crossed >= 400);
  CHECK(std::abs(sum - exact_sum) < 4.0 / 16.0 / std::sqrt(n_crossed) * whole_sum);
}
