// The sky component through openings against integration over the opening as an area.
#include <array>

#include "catch.hpp"
#include "reflection/fresnel.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const Vec3 kSun(std::cos(radians(40.0)) * std::sin(radians(150.0)), std::cos(radians(40.0)) * std::cos(radians(150.0)),
                std::sin(radians(40.0)));

std::string sky_text(int type) {
  std::string text = type == 16 ? "model = \"cie-overcast\"" : "model = \"cie-" + std::to_string(type) + "\"";
  return text + "\nhorizontal = 10000\nsun = { altitude = 40, azimuth = 150 }\n";
}

const std::vector<std::array<double, 6>> kPoints = {
    {2.0, 3.0, 0.8, 0, 0, 1}, {1.0, 1.0, 0.8, 0, 0, 1}, {2.0, 0.5, 0.8, 0, 0, 1},   {3.5, 5.5, 0.8, 0, 0, 1},
    {2.0, 3.0, 1.2, 0, -1, 0}, {2.0, 5.0, 1.5, 0, -1, 0.3}, {0.5, 2.0, 1.0, 0.6, -0.8, 0}, {2.0, 2.0, 0.0, 0, 0, 1}};

std::string points_text() {
  std::string text = "[[sensors]]\nname = \"p\"\npoints = [";
  for (const auto& p : kPoints) {
    text += "[";
    for (const double x : p) text += std::to_string(x) + ",";
    text += "],";
  }
  return text + "]\n";
}

struct Opening {
  std::string text;
  Gap gap;
};

// The wall to the south is y = 0; light travels along +y through it, and along -z through the roof.
const Gap kFacade{{0.5, 0, 0.9}, {0, 0, 1.8}, {3, 0, 0}};
const Gap kRoof{{1.2, 2.0, 3.0}, {0, 1.5, 0}, {1.6, 0, 0}};

std::string room_with(const std::string& features) { return box_text({4, 6, 3}, 0.0, features + points_text()); }

const std::string kFacadeFeature =
    "[[surface]]\nname = \"w\"\non = \"wall-s\"\nvertices = [[3.5,0,0.9],[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7]]\n";
const std::string kRoofFeature =
    "[[surface]]\nname = \"w\"\non = \"ceiling\"\nvertices = [[1.2,2,3],[1.2,3.5,3],[2.8,3.5,3],[2.8,2,3]]\n";

// Both with holes in a surface in place of a window.
std::string open_room(bool roof) {
  const std::string walls =
      "[[surface]]\nname = \"n\"\nfinish = \"grey\"\nvertices = [[0,6,0],[4,6,0],[4,6,3],[0,6,3]]\n"
      "[[surface]]\nname = \"w\"\nfinish = \"grey\"\nvertices = [[0,0,0],[0,6,0],[0,6,3],[0,0,3]]\n"
      "[[surface]]\nname = \"e\"\nfinish = \"grey\"\nvertices = [[4,6,0],[4,0,0],[4,0,3],[4,6,3]]\n"
      "[[surface]]\nname = \"f\"\nfinish = \"grey\"\nvertices = [[0,0,0],[4,0,0],[4,6,0],[0,6,0]]\n";
  const std::string south = "[[surface]]\nname = \"s\"\nfinish = \"grey\"\nvertices = [[0,0,0],[0,0,3],[4,0,3],[4,0,0]]\n";
  const std::string ceiling =
      "[[surface]]\nname = \"c\"\nfinish = \"grey\"\nvertices = [[0,0,3],[0,6,3],[4,6,3],[4,0,3]]\n";
  const std::string south_hole = "holes = [[[3.5,0,0.9],[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7]]]\n";
  const std::string roof_hole = "holes = [[[1.2,2,3],[1.2,3.5,3],[2.8,3.5,3],[2.8,2,3]]]\n";
  return "dim = \"zone/1\"\ncell = 0.5\n[finishes]\ngrey = 0.0\n" + walls + south + (roof ? "" : south_hole) + ceiling +
         (roof ? roof_hole : "") + points_text();
}

// Largest relative difference over points whose sky factor is above 0.5 %.
double worst(const DaylitRoom& room, int type, const Gap& gap,
             const std::function<double(const Vec3&, const Vec3&, double)>& passed, int n_u = 180, int n_v = 180) {
  const double scale = 10000.0 / horizontal_of(type, kSun);
  double most = 0.0;
  int n = 0;
  for (std::size_t p = 0; p < kPoints.size(); ++p) {
    const auto& at = kPoints[p];
    const double expected = through(gap, {at[0], at[1], at[2]}, glm::normalize(Vec3(at[3], at[4], at[5])),
                                    [&](const Vec3& q, const Vec3& direction, double incidence) {
                                      return scale * relative_luminance(type, direction, kSun) * passed(q, direction, incidence);
                                    },
                                    n_u, n_v);
    if (expected < 0.005 * 10000.0) continue;
    ++n;
    most = std::max(most, std::abs(room.direct_lx(p, "sky") / expected - 1.0));
  }
  CHECK(n >= 3);
  return most;
}

double all(const Vec3&, const Vec3&, double) { return 1.0; }

// The slab's transmittance, from the sums of light to and fro, term by term.
class SlabTermByTerm {
 public:
  explicit SlabTermByTerm(double normal_transmittance) {
    double low = 0.0, high = 1.0;
    const double r = std::pow(0.52 / 2.52, 2);
    for (int k = 0; k < 60; ++k) {
      inside_ = (low + high) / 2.0;
      (passes(r, inside_) < normal_transmittance ? low : high) = inside_;
    }
  }

  double operator()(double incidence) const {
    const double refracted = std::sqrt(1.0 - (1.0 - incidence * incidence) / (1.52 * 1.52));
    const double s = std::pow((incidence - 1.52 * refracted) / (incidence + 1.52 * refracted), 2);
    const double p = std::pow((1.52 * incidence - refracted) / (1.52 * incidence + refracted), 2);
    const double a = std::pow(inside_, 1.0 / refracted);
    return (passes(s, a) + passes(p, a)) / 2.0;
  }

 private:
  static double passes(double r, double a) {
    double sum = 0.0, term = (1.0 - r) * a * (1.0 - r);
    for (int k = 0; k < 12; ++k, term *= r * r * a * a) sum += term;
    return sum;
  }
  double inside_ = 0.5;
};

}  // namespace

TEST_CASE("Sky component of an unglazed opening equals integration over its area", "[daylight][validation]") {
  for (const int type : {1, 5, 12, 16}) {
    CAPTURE(type);
    REQUIRE(read(open_room(false)).openings.size() == 1);
    CHECK(worst(daylit(open_room(false), sky_text(type)), type, kFacade, all) < 2e-3);
    CHECK(worst(daylit(open_room(true), sky_text(type)), type, kRoof, all) < 2e-3);
    CHECK(worst(daylit(room_with(kFacadeFeature + "finish = \"hole\"\n"), sky_text(type)), type, kFacade, all) < 2e-3);
  }
}

TEST_CASE("Sky component of a pane is that of the opening times the slab's transmittance", "[daylight][validation]") {
  const SlabTermByTerm slab(0.7);
  const auto passed = [&](const Vec3&, const Vec3&, double incidence) { return slab(incidence); };
  for (const int type : {12, 16}) {
    CHECK(worst(daylit(room_with(kFacadeFeature + "finish = \"pane\"\n"), sky_text(type)), type, kFacade, passed) < 2e-3);
    CHECK(worst(daylit(room_with(kRoofFeature + "finish = \"pane\"\n"), sky_text(type)), type, kRoof, passed) < 2e-3);
  }
}

TEST_CASE("An overhang and a wall opposite hide the sky behind them", "[daylight][validation]") {
  // A canopy 1 m deep above the window, and a wall 8 m high and 20 m long 10 m away.
  const std::string outside =
      "[[surface]]\nname = \"canopy\"\nfinish = \"grey\"\noutside = true\n"
      "vertices = [[-1,-1,2.9],[-1,0,2.9],[5,0,2.9],[5,-1,2.9]]\n"
      "[[surface]]\nname = \"opposite\"\nfinish = \"grey\"\noutside = true\n"
      "vertices = [[-8,-10,0],[-8,-10,8],[12,-10,8],[12,-10,0]]\n";
  const auto free = [](const Vec3& q, const Vec3& d, double) {
    const double to_canopy = (2.9 - q.z) / d.z, to_wall = -10.0 / d.y;
    const Vec3 c = q + to_canopy * d, w = q + to_wall * d;
    if (to_canopy > 0.0 && c.x > -1.0 && c.x < 5.0 && c.y > -1.0 && c.y < 0.0) return 0.0;
    return to_wall > 0.0 && w.x > -8.0 && w.x < 12.0 && w.z > 0.0 && w.z < 8.0 ? 0.0 : 1.0;
  };
  // Edges of shadows are level: the rows are many.
  for (const int type : {12, 16}) {
    CAPTURE(type);
    CHECK(worst(daylit(room_with(kFacadeFeature + "finish = \"hole\"\n" + outside), sky_text(type)), type, kFacade, free,
                3600, 720) < 2e-3);
  }
}
