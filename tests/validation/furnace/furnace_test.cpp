// See README.md beside this file.
#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// Covers every surface of the zone, all of them rectangles.
Lights luminous_faces(const Zone& zone, double luminance_cd_m2) {
  Lights lights;
  for (const Surface& surface : zone.surfaces) {
    const Ring3 ring = surface.polygon.corners().front();
    const Vec3 along = ring[1] - ring[0], across = ring[2] - ring[1];
    const double length_m = glm::length(along), width_m = glm::length(across);
    Luminaire& lamp = add_lamp(lights, surface.name, (ring[0] + ring[2]) / 2.0,
                               IntensityTable::lambertian(luminance_cd_m2 * length_m * width_m),
                               {.aim = surface.polygon.normal(), .opening = rectangle(length_m, width_m)});
    lamp.c0 = along / length_m;
    lamp.c90 = glm::cross(lamp.c0, lamp.aim);
  }
  return lights;
}

Zone furnace(bool with_box, double reflectance, double cell_m) {
  Zone zone = box_zone({4.1, 3.3, 2.6}, reflectance, cell_m);
  zone.closed = true;
  if (with_box) add_box(zone, "box.", {-0.9, -0.6, -0.5}, {0.4, 0.5, 0.3}, 0, cell_m, true);
  zone.points = {{{1.2, 0.9, 0.1}, {0, 0, 1}},
                 {{-1.9, -1.5, -1.2}, glm::normalize(Vec3(1, 2, 3))},
                 {{0.41, 0.0, 0.0}, {-1, 0, 0}},
                 {{-0.2, 0.1, 0.31}, {0, 0, -1}}};
  return zone;
}

}  // namespace

TEST_CASE("Where all surfaces shine alike every cell and point has pi L", "[furnace][validation]") {
  const bool with_box = GENERATE(false, true);
  const double cell_m = GENERATE(0.5, 0.2), reflectance = GENERATE(0.0, 0.6);
  const Zone zone = furnace(with_box, reflectance, cell_m);
  const double luminance_cd_m2 = 7.0, exact_lx = kPi * luminance_cd_m2 / (1.0 - reflectance);
  const SimulationOptions options{.combine = Combine::all, .gather = {.tolerance = 1e-6}};
  const auto solution =
      solve(zone, luminous_faces(zone, luminance_cd_m2), network_of(zone, {8, 16}), options);
  const auto lx = cell_lx(solution);
  const Cells cells(zone);
  CAPTURE(with_box, cell_m, reflectance);
  double worst = 0.0, squares = 0.0;
  for (const double at_cell : lx) {
    const double off = at_cell / exact_lx - 1.0;
    worst = std::max(worst, std::abs(off));
    squares += off * off / static_cast<double>(lx.size());
  }
  CHECK(worst <= 1e-2);
  CHECK(std::sqrt(squares) <= 4e-3);
  CHECK(std::abs(total(cells, lx) / area_m2(cells) / exact_lx - 1.0) <= 2e-4);
  for (const double at_point : point_lx(solution)) CHECK(at_point == Approx(exact_lx).epsilon(3e-3));
}
