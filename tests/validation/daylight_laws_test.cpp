// Closed forms and conservation laws of daylight: furnace, open field, coefficients against one sky, energy, sun.
#include <array>

#include "catch.hpp"
#include "sky/sky_by_patches.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kWindow =
    "[[surface]]\nname = \"w\"\non = \"wall-s\"\nvertices = [[3.5,0,0.9],[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7]]\n";
const std::string kPoints =
    "[[sensors]]\nname = \"p\"\npoints = [[2,3,0.8, 0,0,1],[1,1,0.8, 0,0,1],[3,5,0.8, 0,0,1],[2,4,1.5, 0,-1,0]]\n";

// Lambert's polygon sum: configuration factor times pi of a polygon wholly before a point's plane.
double projected_sr(const std::vector<Vec3>& ring, const Vec3& at, const Vec3& normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 a = glm::normalize(ring[i] - at), b = glm::normalize(ring[(i + 1) % ring.size()] - at);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
  }
  return std::abs(sum) / 2.0;
}

double worst_open(const DaylitRoom& room) { return std::abs(worst_balance(room.solution.sources).imbalance); }

}  // namespace

TEST_CASE("Under a uniform outside a point gets the view factor of the opening", "[daylight][validation]") {
  const DaylitRoom room = daylit(box_text({4, 6, 3}, 0.0, kWindow + "finish = \"hole\"\n" + kPoints),
                                 "model = \"uniform\"\nhorizontal = 3141.592653589793\nground = 0.999999999\n");
  const std::vector<Vec3> window{{3.5, 0, 0.9}, {0.5, 0, 0.9}, {0.5, 0, 2.7}, {3.5, 0, 2.7}};
  const std::vector<std::pair<Vec3, Vec3>> points{
      {{2, 3, 0.8}, {0, 0, 1}}, {{1, 1, 0.8}, {0, 0, 1}}, {{3, 5, 0.8}, {0, 0, 1}}, {{2, 4, 1.5}, {0, -1, 0}}};
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double lx = room.direct_lx(p, "sky") + room.direct_lx(p, "ground");
    CHECK(lx == Approx(1000.0 * projected_sr(window, points[p].first, points[p].second)).epsilon(5e-4));
  }
}

TEST_CASE("A level point in the open gets the horizontal illuminance", "[daylight][validation]") {
  const std::string field =
      "dim = \"zone/1\"\ncell = 2\n[finishes]\ngrey = 0.2\n[[surface]]\nname = \"floor\"\nfinish = \"grey\"\n"
      "vertices = [[0,0,0],[4,0,0],[4,4,0],[0,4,0]]\n[[sensors]]\nname = \"p\"\npoints = [[2,2,0.5, 0,0,1]]\n";
  for (const char* model : {"cie-1", "cie-5", "cie-8", "cie-12", "cie-15", "cie-overcast"}) {
    CAPTURE(model);
    const auto room = daylit(field, std::string("model = \"") + model +
                                        "\"\nhorizontal = 10000\nsun = { altitude = 35, azimuth = 200 }\n");
    CHECK(room.direct_lx(0, "sky") == Approx(10000.0).epsilon(1e-3));
  }
  const auto room = daylit(field, "model = \"tregenza\"\n");
  const SkyPatches patches;
  double sum = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const double lx = room.direct_lx(0, "sky[" + std::to_string(p) + "]");
    CHECK(lx == Approx(patches.horizontal_sr(p)).epsilon(1e-3));
    sum += lx;
  }
  CHECK(sum == Approx(kPi).epsilon(1e-3));
}

TEST_CASE("Coefficients under an overcast sky are the overcast solution", "[daylight][validation]") {
  const std::string zone = box_text({4, 6, 3}, 0.5, kWindow + "finish = \"pane\"\n" + kPoints);
  const auto one = daylit(zone, "model = \"cie-overcast\"\nhorizontal = 10000\n", {16, 32});
  for (const char* model : {"model = \"tregenza\"\n", "model = \"reinhart\"\nsubdivision = 2\n"}) {
    const auto all = daylit(zone, model, {16, 32});
    const SkyPatches patches(all.solution.sky->subdivision);
    const auto cd_m2 = sky_by_patches(Sky(SkyModel::overcast(), {0, 0, 1}, 10000.0), patches)
                           .columns_cd_m2(patches, 0.2 * 10000.0 / kPi);
    REQUIRE(all.solution.sources.size() == cd_m2.size());
    for (std::size_t p = 0; p < 4; ++p) {
      double lx = 0.0;
      for (std::size_t k = 0; k < cd_m2.size(); ++k) lx += all.total_lx(p, k) * cd_m2[k];
      CAPTURE(model, p);
      CHECK(lx == Approx(one.total_lx(p, 0) + one.total_lx(p, 1)).epsilon(5e-3));
    }
  }
}

TEST_CASE("Light that comes in by windows is absorbed or leaves again", "[daylight][validation]") {
  const std::string roof = "[[surface]]\nname = \"r\"\non = \"ceiling\"\nfinish = \"pane\"\n"
                           "vertices = [[1.2,2,3],[1.2,3.5,3],[2.8,3.5,3],[2.8,2,3]]\n";
  const std::string wall = "[[surface]]\nname = \"o\"\nfinish = \"grey\"\noutside = true\n"
                           "vertices = [[12,-10,0],[-8,-10,0],[-8,-10,8],[12,-10,8]]\n";
  const std::string sun = "model = \"cie-12\"\nhorizontal = 10000\ndirect_normal = 50000\n"
                          "sun = { altitude = 40, azimuth = 170 }\n";
  for (const auto& more : {std::string(), roof, roof + wall}) {
    CHECK(worst_open(daylit(box_text({4, 6, 3}, 0.5, kWindow + "finish = \"pane\"\n" + more, 0.25), sun, {16, 32})) < 2e-3);
    CHECK(worst_open(daylit(box_text({4, 6, 3}, 0.5, kWindow + "finish = \"pane\"\n" + more, 0.25),
                            "model = \"tregenza\"\n", {16, 32})) < 2e-3);
  }
}

TEST_CASE("The sun brings its beam times cosine and transmittance, in the sun patch only", "[daylight][validation]") {
  // Due south of a facade that faces south (-y), 45 degrees up: the patch lies from the sill's to the head's height.
  const auto room = daylit(box_text({4, 6, 3}, 0.0,
                                    kWindow + "finish = \"pane\"\n[[sensors]]\nname = \"p\"\n"
                                              "points = [[2,1.8,0, 0,0,1],[2,0.5,0, 0,0,1],[2,3.2,0, 0,0,1]]\n"),
                           "model = \"uniform\"\nhorizontal = 1000\ndirect_normal = 80000\n"
                           "sun = { altitude = 45, azimuth = 180 }\n");
  const double c = std::sqrt(0.5), t = std::sqrt(1.0 - 0.5 / (1.52 * 1.52));
  const auto passes = [](double r, double a) { return (1 - r) * (1 - r) * a / (1 - r * r * a * a); };
  const double r0 = std::pow(0.52 / 2.52, 2);
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) (passes(r0, (low + high) / 2) < 0.7 ? low : high) = (low + high) / 2;
  const double s = std::pow((c - 1.52 * t) / (c + 1.52 * t), 2), p = std::pow((1.52 * c - t) / (1.52 * c + t), 2);
  const double tau = (passes(s, std::pow(low, 1 / t)) + passes(p, std::pow(low, 1 / t))) / 2;
  CHECK(room.direct_lx(0, "sun") == Approx(80000.0 * c * tau).epsilon(1e-3));
  CHECK(room.direct_lx(1, "sun") == 0.0);
  CHECK(room.direct_lx(2, "sun") == 0.0);
}

TEST_CASE("A diffusing pane glows evenly with what falls on it", "[daylight][validation]") {
  const std::string zone = box_text({4, 6, 3}, 0.0, kWindow + "finish = \"opal\"\n" + kPoints);
  const std::string opal =
      "[finishes]\nopal = { kind = \"glazing\", transmittance = 0.4, reflectance = 0, angular_law = \"diffusing\" }\n";
  std::string text = zone;
  text.replace(text.find("[finishes]\n"), 11, opal);
  // Half of a vertical face's hemisphere is sky of 1000 cd/m2, half is black ground.
  const auto room = daylit(text, "model = \"uniform\"\nhorizontal = 3141.592653589793\nground = 0\n");
  const std::vector<Vec3> window{{3.5, 0, 0.9}, {0.5, 0, 0.9}, {0.5, 0, 2.7}, {3.5, 0, 2.7}};
  const double glow_cd_m2 = 0.4 * (kPi * 1000.0 / 2.0) / kPi;
  CHECK(room.direct_lx(0, "sky") == Approx(glow_cd_m2 * projected_sr(window, {2, 3, 0.8}, {0, 0, 1})).epsilon(1e-3));
  CHECK(room.direct_lx(3, "sky") == Approx(glow_cd_m2 * projected_sr(window, {2, 4, 1.5}, {0, -1, 0})).epsilon(1e-3));
  CHECK(worst_open(room) < 2e-3);
}

TEST_CASE("States of a group of windows are sources of their own", "[daylight][validation]") {
  std::string text = box_text({4, 6, 3}, 0.3, kWindow + "finish = \"pane\"\ngroup = \"south\"\n"
                                                        "states = { shut = \"blind\" }\n" + kPoints);
  text.replace(text.find("[finishes]\n"), 11,
               "[finishes]\nblind = { kind = \"glazing\", transmittance = 0.35, ior = 1.52, angular_law = \"constant\" }\n");
  const auto room = daylit(text, "model = \"cie-overcast\"\nhorizontal = 10000\n");
  REQUIRE(room.solution.sources.size() == 4);
  CHECK(room.solution.sources[0].group == "south");
  CHECK(room.solution.sources[0].daylight->state == "pane");
  CHECK(room.solution.sources[2].daylight->state == "shut");
  CHECK(room.solution.sources[0].daylight->as_it_stands);
  CHECK_FALSE(room.solution.sources[2].daylight->as_it_stands);
  CHECK(room.total_lx(0, 2) < 0.7 * room.total_lx(0, 0));
}
