#include "network/point_places.hpp"

#include <cmath>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "unit/scene_support.hpp"

using namespace dim;

namespace {

Zone judged(const std::string& text) {
  Zone zone = test::read(text);
  judge_points(test::network_of(zone, {8, 16}), zone);
  return zone;
}

Vec3 place(const Zone& zone, std::size_t p) { return zone.points[p].position + zone.origin_m; }

const std::string kDesk = R"([[box]]
name = "desk"
finish = "dark"
corner = [1,1,0]
size = [2,1,0.75]
)";

}  // namespace

TEST_CASE("Of a plane that reaches beyond the walls the points inside the room count",
          "[network][property]") {
  const Zone zone = judged(test::kRoom + R"([[plane]]
name = "over"
vertices = [[-0.3,-0.3,0.8],[6.3,-0.3,0.8],[6.3,4.3,0.8],[-0.3,4.3,0.8]]
grid = [12, 8]
)");
  REQUIRE(zone.points.size() == 96);
  std::size_t n_out = 0;
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    const Vec3 at = place(zone, p);
    const bool inside = at.x > 0 && at.y > 0 && at.x < 6 && at.y < 4;
    CHECK(zone.points[p].valid == inside);
    n_out += !inside;
  }
  const auto warnings = left_out_warnings(zone);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].place.file == "room.toml");
  CHECK(warnings[0].place.line > 30);
  CHECK(warnings[0].what.find("'over': " + std::to_string(n_out) + " of 96 points") == 0);
  CHECK(warnings[0].what.find("(-0.025, -0.0125, 0.8)") != std::string::npos);
}

TEST_CASE("Points on the floor and on top of furniture count, in it and under the floor not",
          "[network][property]") {
  const Zone zone = judged(test::kRoom + kDesk + R"([[sensors]]
name = "good"
points = [[5,3,0, 0,0,1], [2,1.5,0.75, 0,0,1], [0,2,1, 1,0,0], [5,3,3, 0,0,-1], [1e-6,1e-6,1e-6, 0,0,1], [2,1.5,0.750001, 0,0,1]]
[[sensors]]
name = "bad"
points = [[2,1.5,0.5, 0,0,1], [2,1.5,0.749999, 0,0,1], [5,3,-0.01, 0,0,1], [5,3,3.01, 0,0,1], [-2,2,1, 1,0,0], [-2,2,1, -1,0,0]]
)");
  REQUIRE(zone.points.size() == 12);
  for (std::size_t p = 0; p < 6; ++p) CHECK(zone.points[p].valid);
  for (std::size_t p = 6; p < 12; ++p) CHECK_FALSE(zone.points[p].valid);
  const auto warnings = left_out_warnings(zone);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what.find("'bad': 6 of 6 points") == 0);
  CHECK(warnings[0].what.find(", ...") != std::string::npos);
}

TEST_CASE("Before an open zone a point counts unless it sees mostly backs", "[network][property]") {
  std::string text = test::kRoom;
  text.erase(text.rfind("[[surface]]"));  // no east wall
  const Zone zone = judged(text + kDesk + R"([[sensors]]
name = "points"
points = [[8,2,1, -1,0,0], [8,2,1, 0,0,1], [-0.1,2,1, 1,0,0], [2,1.5,0.5, 0,0,1], [5.5,3,1, 1,0,0]]
)");
  CHECK_FALSE(zone.closed);
  const std::vector<bool> expected = {true, true, false, false, true};
  for (std::size_t p = 0; p < expected.size(); ++p) CHECK(zone.points[p].valid == expected[p]);
}
