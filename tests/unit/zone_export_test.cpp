#include "scene/zone_export.hpp"

#include <map>
#include <sstream>

#include "catch.hpp"
#include "geometry/bridge.hpp"
#include "rooms.hpp"

using namespace dim;

namespace {

/// Areas of the polygons of a Radiance scene by name, from its text alone.
std::map<std::string, double> radiance_areas(const std::string& text) {
  std::map<std::string, double> areas;
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);  // the comment
  std::string material, type, name;
  while (in >> material >> type >> name) {
    std::size_t none = 0, n = 0;
    in >> none >> none >> n;
    std::vector<double> numbers(n);
    for (double& number : numbers) in >> number;
    if (type != "polygon") continue;
    Ring3 ring;
    for (std::size_t i = 0; i + 2 < n; i += 3) ring.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    areas[name] += glm::length(newell(ring)) / 2.0;
  }
  return areas;
}

Ring3 square(double lo, double hi) { return {{lo, lo, 0}, {hi, lo, 0}, {hi, hi, 0}, {lo, hi, 0}}; }

}  // namespace

TEST_CASE("Holes joined to the ring around them keep the area", "[export][unit]") {
  const Polygon polygon(square(0, 10), {square(1, 2), square(3, 6), square(7, 9)});
  const auto rings = bridged_rings(polygon);
  REQUIRE(rings.size() == 1);
  CHECK(rings[0].size() == 4 + 3 * (4 + 2));
  CHECK(signed_area(rings[0]) == Approx(100 - 1 - 9 - 4).epsilon(1e-12));
}

TEST_CASE("A Radiance scene has the areas of the zone, far from the origin too", "[export][unit]") {
  Zone zone = test::box_zone({6, 4, 2.8}, 0.5, 1.0);
  zone.origin_m = {1000.1, -50.3, 7.7};
  Surface pierced = zone.surfaces[0];
  pierced.name = "pierced plate";
  pierced.polygon = Polygon(square(0, 2), {square(0.5, 1)});
  zone.surfaces.push_back(pierced);
  Warnings warnings;
  const auto areas = radiance_areas(to_radiance(zone, warnings));
  CHECK(warnings.empty());
  REQUIRE(areas.size() == 7);
  CHECK(areas.at("floor") == Approx(24).epsilon(1e-9));
  CHECK(areas.at("x0") == Approx(11.2).epsilon(1e-9));
  CHECK(areas.at("pierced_plate") == Approx(3.75).epsilon(1e-9));
}
