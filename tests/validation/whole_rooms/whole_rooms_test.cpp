// See README.md beside this file.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "result/point_error.hpp"
#include "scene/lights_reader.hpp"
#include "scene/zone_reader.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kRoot = DIM_SOURCE_DIR;

std::string text_of(const std::string& path) {
  std::ifstream in(kRoot + "/" + path);
  std::ostringstream text;
  text << in.rdbuf();
  INFO(path);
  REQUIRE_FALSE(text.str().empty());
  return text.str();
}

struct Traced {
  std::string plane;
  Vec3 at;
  double lx, standard_error_lx;
};

// plane,point,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,std_error_lx
std::vector<Traced> traced(const std::string& name) {
  std::vector<Traced> points;
  std::istringstream in(text_of("tests/bench/reference/" + name + ".csv"));
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#') || line.starts_with("plane,")) continue;
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    REQUIRE(fields.size() == 10);
    const auto number = [&](std::size_t i) { return std::stod(fields[i]); };
    points.push_back({fields[0], {number(2), number(3), number(4)}, number(8), number(9)});
  }
  return points;
}

// Of the points of one plane, against the tracer.
struct Comparison {
  std::size_t n = 0;
  double bias = 0.0, standard_error = 0.0;  // of the mean, over the mean
  double rms = 0.0;                         // of the points' relative differences
  double covered = 0.0;                     // share of points within their stated error
};

// The zone and its lights as the programs solve them when nothing is asked for.
// @param cell_m  0: as the zone file says
Comparison compare(const std::string& folder, const std::string& name, const std::string& reference,
                   const std::string& plane, bool bodies = false, double cell_m = 0.0) {
  Warnings warnings;
  const DatabaseSearch search{{kRoot + "/db"}};
  const std::string zone_path = folder + "/" + name + ".zone.toml",
                    lights_path = folder + "/" + name + ".lights.toml";
  const Zone zone = read_zone(text_of(zone_path), kRoot + "/" + zone_path, {}, cell_m, search, warnings);
  Lights lights = read_lights(text_of(lights_path), kRoot + "/" + lights_path, {}, zone, search, warnings);
  for (auto& luminaire : lights.luminaires) luminaire.body = bodies;
  NetworkOptions options;
  options.point_patches = automatic_point_patches(zone.points.size());
  const Cells cells(zone);
  const LuminanceDatabase database(
      zone, cells, lights,
      solve(zone, lights, build_network(zone, cells, options, Job{}), {.combine = Combine::all}));
  const auto lx = point_illuminance_lx(database, {1.0});
  const auto stated = point_errors(database, {1.0});
  REQUIRE(stated);
  const auto expected = traced(reference);
  Comparison result;
  double sum = 0.0, sum_traced = 0.0, variance = 0.0, squares = 0.0;
  for (const PointSet& set : zone.point_sets) {
    if (set.name != plane) continue;
    for (std::size_t i = set.first; i < set.first + set.count; ++i) {
      const auto found = std::find_if(expected.begin(), expected.end(), [&](const Traced& p) {
        return p.plane == plane && glm::length(p.at - zone.points[i].position - zone.origin_m) < 1e-6;
      });
      REQUIRE(found != expected.end());
      const Traced& point = *found;
      ++result.n;
      sum += lx[i];
      sum_traced += point.lx;
      variance += point.standard_error_lx * point.standard_error_lx;
      squares += std::pow(lx[i] / point.lx - 1.0, 2);
      result.covered += std::abs(lx[i] - point.lx) <= (*stated)[i].total_lx() + 2.0 * point.standard_error_lx;
    }
  }
  REQUIRE(result.n > 0);
  result.bias = sum / sum_traced - 1.0;
  result.standard_error = std::sqrt(variance) / sum_traced;
  result.covered /= static_cast<double>(result.n);
  result.rms = std::sqrt(squares / static_cast<double>(result.n));
  return result;
}

}  // namespace

TEST_CASE("The office is lit as an independent tracer has it", "[rooms][validation]") {
  const auto [cell_m, most] = GENERATE(std::pair(0.5, 1.5e-3), std::pair(0.0, 1e-3), std::pair(0.1, 1e-3));
  const auto office = compare("examples/02-office", "office", "office", "workplane", false, cell_m);
  CHECK(office.n == 104);
  CHECK(std::abs(office.bias) < most);
  CHECK(office.covered >= 0.95);
}

TEST_CASE("The office with black luminaires is lit as an independent tracer has it", "[bodies][validation]") {
  const double cell_m = GENERATE(0.0, 0.15, 0.1);  // 0: as the file has them
  const auto office = compare("examples/02-office", "office", "office-black-bodies", "workplane", true, cell_m);
  CHECK(office.n == 104);
  CHECK(std::abs(office.bias) < 1e-3);
}

TEST_CASE("A corridor's far leg is lit as an independent tracer has it", "[rooms][validation]") {
  const auto far = compare("tests/bench/scenes", "corridor", "corridor", "far");
  CHECK(far.n == 36);
  CHECK(far.rms < 1.0e-2);
  CHECK(far.covered >= 0.95);
}
