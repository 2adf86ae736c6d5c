// Mixes and figures on numbers made by hand.
#include <algorithm>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "result/luminous.hpp"

using namespace dim;

namespace {

Source named(const std::string& name, const std::string& group) {
  Source source;
  source.name = name;
  source.group = group;
  return source;
}

const std::vector<Source> kSources = {named("A1", "row A"), named("A2", "row A"), named("B=1", "B")};

std::string refused(const std::string& text) {
  try {
    parse_mix({text}, kSources);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A mix is one for every source that is not named", "[result][unit]") {
  CHECK(parse_mix({}, kSources) == Mix{1, 1, 1});
  CHECK(parse_mix({"A1=0.25"}, kSources) == Mix{0.25, 1, 1});
  CHECK(parse_mix({"row A=0"}, kSources) == Mix{0, 0, 1});
  CHECK(parse_mix({"row A=0", "A2=3e-1"}, kSources) == Mix{0, 0.3, 1});
  CHECK(parse_mix({"A2=0.5", "row A=2"}, kSources) == Mix{2, 2, 1});
  CHECK(parse_mix({"B=1=0.5"}, kSources) == Mix{1, 1, 0.5});
}

TEST_CASE("A mix that cannot be meant is refused with the text", "[result][unit]") {
  for (const std::string text : {"A1", "A1=", "A1=-1", "A1=nan", "A1=inf", "A1=1x", "A1=1e999"}) {
    CAPTURE(text);
    CHECK(refused(text).find("'" + text + "'") != std::string::npos);
  }
  CHECK(refused("A3=1").find("A3") != std::string::npos);
  CHECK(refused("row a=1").find("row A") != std::string::npos);
}

TEST_CASE("Only keeps one source's factor", "[result][unit]") {
  CHECK(only({0.5, 2.0, 1.0}, 1) == Mix{0, 2.0, 0});
}

TEST_CASE("Grid statistics of five numbers", "[result][unit]") {
  const std::vector<double> lx = {1000, 200, 100, 400, 500, 0, 0};
  std::vector<MeasuringPoint> points(lx.size());
  const auto s = grid_statistics(lx, points, {"work", 1, 4});
  CHECK(s.n_points == 4);
  CHECK(s.min_lx == 100);
  CHECK(s.max_lx == 500);
  CHECK(s.mean_lx == Approx(300));
  CHECK(s.u0 == Approx(1.0 / 3.0));
  CHECK(s.ud == Approx(0.2));
  const auto dark = grid_statistics(lx, points, {"dark", 5, 2});
  CHECK(dark.u0 == 0.0);
  CHECK(dark.ud == 0.0);
  points[2].valid = points[6].valid = false;
  const auto most = grid_statistics(lx, points, {"work", 1, 4});
  CHECK(most.n_points == 4);
  CHECK(most.n_left_out == 1);
  CHECK(most.min_lx == 200);
  CHECK(most.mean_lx == Approx(1100.0 / 3.0));
  const auto none = grid_statistics(lx, points, {"none", 6, 1});
  CHECK(none.n_left_out == 1);
  CHECK(std::isnan(none.mean_lx));
  CHECK(std::isnan(none.u0));
}

TEST_CASE("Figures of a surface are weighted by its cells' areas", "[result][unit]") {
  // An L of three squares of 1 m2 in a grid of 2 m: four squares of which one is empty, cells of 1 m2; then a
  // rectangle of 2.5 x 1 m in cells of 1.25 m.
  Zone zone;
  zone.diameter_m = 5.0;
  const int grey = test::add_grey(zone, 0.5);
  test::add_surface(zone, "triangle", {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, grey, 1.0);
  zone.surfaces.back().grid = {2, 1};
  test::add_floor(zone, {0, 0}, {2.5, 1}, 0.0, 2, 1);
  const Cells cells(zone);
  CellAppearance appearance;
  double mean_lx = 0.0, area = 0.0;
  Vec3 mean_xyz(0.0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double lx = static_cast<double>(i + 1) * 10.0;
    appearance.illuminance_lx.push_back(lx);
    appearance.xyz_cd_m2.push_back(Vec3(lx, 2 * lx, 3 * lx));
    if (i >= cells.first(1)) continue;
    area += cells.area_m2(i);
    mean_lx += cells.area_m2(i) * lx;
    mean_xyz += cells.area_m2(i) * Vec3(lx, 2 * lx, 3 * lx);
  }
  const auto figures = surface_figures(cells, appearance);
  REQUIRE(figures.size() == 2);
  CHECK(area == Approx(2.0).epsilon(1e-12));
  CHECK(figures[0].area_m2 == Approx(2.0).epsilon(1e-12));
  CHECK(figures[0].illuminance_mean_lx == Approx(mean_lx / 2.0));
  CHECK(figures[0].xyz_mean_cd_m2.z == Approx(mean_xyz.z / 2.0));
  CHECK(figures[0].illuminance_min_lx == 10.0);
  CHECK(figures[0].illuminance_max_lx == Approx(10.0 * static_cast<double>(cells.first(1))));
  const double first = static_cast<double>(cells.first(1) + 1) * 10.0;
  CHECK(figures[1].illuminance_mean_lx == Approx(first + 5.0));
  CHECK(figures[1].area_m2 == Approx(2.5));
}

TEST_CASE("A source's own colour has unit luminance", "[result][unit]") {
  Source source;
  source.weights = band_weights(SpectralCurve(1.0), Bands::uniform(7));
  const Vec3 white = source_xyz(source);
  CHECK(white.y == 1.0);
  // Illuminant E: X = Y = Z, to the tables' fourth digit.
  CHECK(white.x == Approx(1.0).epsilon(3e-4));
  CHECK(white.z == Approx(1.0).epsilon(3e-4));
}
