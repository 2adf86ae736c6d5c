#include "transport/cell_smoothing.hpp"

#include <random>

#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// A panel from wall to wall stands on the floor, not between two squares.
Zone divided_room(double x) {
  Zone zone = box_zone({4, 3, 2.5}, 0.5, 0.5);
  add_surface(zone, "panel", {{x, -1.5, -1.25}, {x, 1.5, -1.25}, {x, 1.5, 1.25}, {x, -1.5, 1.25}}, 0, 0.5);
  Surface back = zone.surfaces.back();
  back.polygon = back.polygon.reversed();
  back.twin = 6;
  zone.surfaces.back().twin = 7;
  zone.surfaces.push_back(back);
  return zone;
}

}  // namespace

TEST_CASE("Smoothing leaves even light alone and keeps each surface's flux", "[gather][unit]") {
  const Zone zone = furnished_room(0.5, 0.4);
  const Cells cells(zone);
  const CellSmoothing smoothing(cells);
  std::vector<double> change;
  smoothing.change(std::vector<double>(2 * cells.size(), 7.0), 2, change);
  for (const double x : change) REQUIRE(x == 0.0);

  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> lx(0.0, 100.0);
  std::vector<double> light(cells.size());
  for (double& x : light) x = lx(random);
  smoothing.change(light, 1, change);
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    double flux = 0.0, changed = 0.0;
    for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
      flux += cells.area_m2(i) * light[i];
      changed += cells.area_m2(i) * change[i];
    }
    CHECK(std::abs(changed) <= 1e-12 * flux);
  }
}

TEST_CASE("A wave is lessened as by means over twice the cells' size", "[gather][unit]") {
  // 1/4, 1/2, 1/4 lets through cos^2(k h / 2) of a wave of number k along one axis, all of what is even.
  const Zone zone = box_zone({10, 1, 1}, 0.5, 0.1);
  const Cells cells(zone);
  std::vector<double> light(cells.size()), change;
  const auto wave = [&](std::size_t i) { return std::cos(2.0 * kPi * cells[i].centroid.x / 1.25); };
  for (std::size_t i = 0; i < cells.size(); ++i) light[i] = wave(i);
  CellSmoothing(cells).change(light, 1, change);
  const double through = std::pow(std::cos(2.0 * kPi * 0.1 / 1.25 / 2.0), 2);
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    const double x = cells[i].centroid.x;
    if (x > 0.2 && x < 9.8) CHECK(change[i] == Approx((through - 1.0) * wave(i)).margin(1e-12));
  }
}

TEST_CASE("Smoothing stops at the foot of a partition", "[gather][unit]") {
  const double x = GENERATE(0.0, 0.1, 0.25);
  const Zone zone = divided_room(x);
  const Cells cells(zone);
  std::vector<double> light(cells.size()), change;
  const auto beyond = [&](std::size_t i) {
    return zone.surfaces[cells.surface_of(i)].polygon.frame().to_world(cells[i].centroid).x > x;
  };
  for (std::size_t i = 0; i < cells.first(6); ++i) light[i] = beyond(i) ? 0.0 : 100.0;
  CellSmoothing(cells).change(light, 1, change);
  for (std::size_t i = 0; i < cells.first(6); ++i) CHECK(change[i] == 0.0);
}
