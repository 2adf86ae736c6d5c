// The background of UGR against the network's own hemisphere of a measuring point that looks where the eye
// does.
#include "catch.hpp"
#include "glare/glare_field.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("The background at an eye is the indirect illuminance of a measuring point there, over pi",
          "[glare][validation]") {
  Zone zone = box_zone({5, 4, 2.8}, 0.6, 0.25);
  add_box(zone, "cupboard", {-2.4, -1.9, -1.39}, {-1.2, -1.3, 0.4}, add_grey(zone, 0.3), 0.25, true);
  const Vec3 eye(0.4, 0.6, -0.2);
  const std::vector<Vec3> directions = {{1, 0, 0}, {0, -1, 0}, glm::normalize(Vec3(-1, 0.5, 0.2))};
  for (const Vec3& d : directions) zone.points.push_back({eye, d});
  Lights lights;
  for (const double x : {-1.2, 1.2})
    add_lamp(lights, x < 0 ? "a" : "b", {x, 0.3, 1.39}, IntensityTable::lambertian(800.0), {.group = "row"});
  const Cells cells(zone);
  NetworkOptions options;
  options.patches = {16, 32};
  options.point_patches = {32, 64};
  const Network network = build_network(zone, cells, options, Job{});
  const Solution solution = solve(zone, lights, network);
  std::vector<double> indirect_lx(directions.size(), 0.0);
  for (std::size_t s = 0; s < solution.sources.size(); ++s) {
    REQUIRE(solution.classes.size() == 1);
    for (std::size_t p = 0; p < directions.size(); ++p)
      indirect_lx[p] += static_cast<double>(solution.point_total[solution.point_row(s, 0) + p]) -
                        static_cast<double>(solution.point_direct[s * solution.n_points + p]);
  }
  const LuminanceDatabase database(zone, cells, lights, solution);
  const GlareField field(database, Mix(database.sources().size(), 1.0));
  const EyePlace place = field.at(eye);
  for (std::size_t p = 0; p < directions.size(); ++p) {
    CAPTURE(p, indirect_lx[p]);
    CHECK(background_cd_m2(place, LineOfSight::along(directions[p])) ==
          Approx(indirect_lx[p] / kPi).epsilon(0.01));
  }
}
