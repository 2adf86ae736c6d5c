// What bodies leave free of the cells that they lie on.
#include "network/lying_bodies.hpp"

#include "catch.hpp"
#include "network/cell_points.hpp"
#include "property/transport_support.hpp"
#include "scene/luminaire_body.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr double kCell_m = 0.5;

// A room with panels of 0.6 m beneath its ceiling (at z = 1).
struct Ceiling {
  Zone zone;
  Cells cells;
  std::size_t n_zone_cells = 0;

  Ceiling(std::initializer_list<Vec3> panels, double reflectance = 0.0) {
    const Zone bare = box_zone({4, 4, 2}, 0.5, kCell_m);
    Lights lights;
    for (const Vec3& at : panels) {
      add_lamp(lights, "panel" + std::to_string(lights.luminaires.size()), at, IntensityTable::lambertian(1.0),
               {.opening = rectangle(0.6, 0.6), .body = true});
      lights.luminaires.back().body_reflectance = reflectance;
    }
    zone = with_bodies(bare, lights, kCell_m);
    n_zone_cells = Cells(bare).size();
    cells = Cells(Cells(bare), zone);
    leave_free_of_bodies(cells, zone, bare.surfaces.size());
  }

  double covered_m2() const {
    double m2 = 0.0;
    for (std::size_t i = 0; i < n_zone_cells; ++i)
      m2 += cells.covered(i) ? cells[i].area_m2 : cells[i].area_m2 - cells.area_m2(i);
    return m2;
  }
};

}  // namespace

TEST_CASE("Bodies on a ceiling cover what they are large, wherever they lie", "[bodies][network][unit]") {
  const auto [x, y] = GENERATE(std::pair(0.0, 0.0), std::pair(0.25, 0.25), std::pair(0.37, -0.81),
                               std::pair(1.7, 1.7), std::pair(-1.2, 0.5));
  const double gap_m = GENERATE(2e-4, 0.01, 0.04);
  CHECK(Ceiling({{x, y, 1.0 - gap_m}}).covered_m2() == Approx(0.36).epsilon(1e-9));
}

TEST_CASE("Bodies that overlap cover their common part once", "[bodies][network][unit]") {
  CHECK(Ceiling({{0.1, 0.0, 0.999}, {0.4, 0.2, 0.998}}).covered_m2() == Approx(0.72 - 0.3 * 0.4).epsilon(1e-9));
}

TEST_CASE("What hangs lower than a tenth of a cell covers nothing", "[bodies][network][unit]") {
  CHECK(Ceiling({{0.1, 0.0, 1.0 - 0.051}}).covered_m2() == 0.0);
}

TEST_CASE("What reaches over an edge covers up to it", "[bodies][network][unit]") {
  CHECK(Ceiling({{1.9, 0.0, 0.999}}).covered_m2() == Approx(0.6 * 0.4).epsilon(1e-9));
}

TEST_CASE("Rays of a cell that is covered in part start beside the body", "[bodies][network][unit]") {
  const Ceiling room({{0.1, 0.0, 0.999}});
  std::size_t n_part = 0;
  for (std::size_t i = 0; i < room.n_zone_cells; ++i) {
    if (room.cells.free_part(i) == nullptr) continue;
    ++n_part;
    const CellPoints in_cell(room.zone, room.cells, i);
    const Frame& frame = room.zone.surfaces[room.cells.surface_of(i)].polygon.frame();
    for (int k = 0; k < 100; ++k) {
      const Vec3 p = frame.to_world(in_cell(0.01 * k, 0.005 + 0.01 * ((37 * k) % 100)));
      CHECK_FALSE((std::abs(p.x - 0.1) < 0.3 - 1e-6 && std::abs(p.y) < 0.3 - 1e-6));
      CHECK(p.z == Approx(1.0));
    }
  }
  CHECK(n_part > 0);
}
