// CIE 171:2006, 5.2 to 5.4: light that comes straight from luminaires. See README.md beside this file.
#include "catch.hpp"
#include "validation/cie171/cie171_rooms.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("CIE 171 5.2: a point source lights by the inverse square and cosine laws", "[cie171][validation]") {
  // Twenty directions' intensities of a table are not in question here: the source is even, then a cosine.
  Zone zone = cie171_room({4, 4, 3}, 0.0);
  const Vec3 at(0.0, 0.0, 1.5 - 1e-4);
  for (int i = 0; i < 7; ++i) {
    const double along = -1.5 + 0.5 * i;
    zone.points.push_back({{along, 0.25, -1.5}, {0, 0, 1}});
    zone.points.push_back({{along, -1.75, -1.5}, {0, 0, 1}});
    zone.points.push_back({{2.0, along, -1.25}, {-1, 0, 0}});
    zone.points.push_back({{along, -2.0, 0.75}, {0, 1, 0}});
  }
  const bool cosine = GENERATE(false, true);
  Lights lights;
  add_lamp(lights, "lamp", at, cosine ? IntensityTable::lambertian(1000.0) : IntensityTable::isotropic(1000.0));
  const auto lx = point_lx(solve_at_defaults(zone, lights));
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    const Vec3 ray = zone.points[p].position - at;
    const double r = glm::length(ray), incidence = -glm::dot(ray, zone.points[p].normal) / r;
    const double intensity_cd = cosine ? -1000.0 * ray.z / r : 1000.0;
    CHECK(lx[p] == Approx(intensity_cd * incidence / (r * r)).epsilon(1e-6));
  }
}

TEST_CASE("CIE 171 5.3: a Lambertian panel lights by Lambert's sum, near, far and grazing", "[cie171][validation]") {
  Zone zone = cie171_room({4, 4, 3}, 0.0);
  const double z = 1.5;
  const Ring3 panel = {{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}};
  for (int i = 0; i < 8; ++i) {
    const double along = -1.75 + 0.5 * i;
    zone.points.push_back({{along, along, -1.5}, {0, 0, 1}});     // across the floor, by its diagonal
    zone.points.push_back({{along, 0.25, -1.5}, {0, 0, 1}});
    zone.points.push_back({{2.0, along, -1.25}, {-1, 0, 0}});     // along a wall
    zone.points.push_back({{2.0, 0.0, -1.3 + 0.38 * i}, {-1, 0, 0}});  // up to 0.14 m under the panel's plane
  }
  for (const double below_m : {0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
    zone.points.push_back({{0.1, 0.2, z - below_m}, {0, 0, 1}});   // close under the panel
    zone.points.push_back({{0.45, 0.1, z - below_m}, {0, 0, 1}});  // and its rim
    zone.points.push_back({{1.5, 0.3, z - below_m}, {-1, 0, 0}});  // the panel seen ever more from its edge
    zone.points.push_back({{1.5, 0.3, z - below_m}, {0, 0, 1}});   // and lighting at a grazing angle as well
  }
  Lights lights;
  add_lamp(lights, "panel", {0, 0, z}, IntensityTable::lambertian(1000.0), {.opening = rectangle(1.0, 1.0)});
  const auto lx = point_lx(solve_at_defaults(zone, lights));
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    const auto& point = zone.points[p];
    CAPTURE(point.position.x, point.position.y, point.position.z, point.normal.z);
    CHECK(lx[p] == Approx(lambert_lx(point.position, point.normal, panel, 1000.0)).epsilon(5e-4));
  }
}

TEST_CASE("CIE 171 5.4: what comes through an opening is what the surfaces behind it get", "[cie171][validation]") {
  // A roof opening of 1 to 4 m edge over a black room of 4 x 4 x 3 m; the sky above is even, 1000 cd/m2, so that the
  // opening lets in pi L A.
  const double edge = GENERATE(1.0, 2.0, 3.0, 4.0);
  const DaylitRoom room = under_sky(roof_room(edge, "hole", ""), "model = \"uniform\"\nhorizontal = 3141.592653589793\n");
  const Cells cells(room.zone);
  double flux_lm = 0.0;
  for (std::size_t s = 0; s < room.solution.sources.size(); ++s) {
    for (std::size_t i = 0; i < room.solution.n_cells; ++i)
      flux_lm += cells.area_m2(i) *
                 static_cast<double>(room.solution.cell_direct[s * room.solution.n_direct_classes * room.solution.n_cells + i]);
  }
  CAPTURE(edge);
  CHECK(flux_lm == Approx(kPi * 1000.0 * edge * edge).epsilon(1e-3));
}
