// The side-lit room of the examples, with a canopy and a house opposite, under an overcast sky.
#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "sky/sky_by_patches.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const std::string kOvercast = "model = \"cie-overcast\"\nhorizontal = 10000\nground = 0.2\n";

Zone side_lit_room(const std::string& cell) {
  std::ifstream file(DIM_SOURCE_DIR "/examples/06-daylight-factor/room.zone.toml");
  std::stringstream text;
  text << file.rdbuf();
  return read(text.str(), {"cell=" + cell});
}

std::vector<double> sky_and_ground_lx(const DaylitRoom& room) {
  std::vector<double> lx;
  for (std::size_t p = 0; p < room.zone.points.size(); ++p) lx.push_back(room.total_lx(p, 0) + room.total_lx(p, 1));
  return lx;
}

struct Difference {
  double rms = 0.0, most = 0.0;
};

Difference difference(const std::vector<double>& found, const std::vector<double>& expected) {
  Difference d;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const double off = found[p] / expected[p] - 1.0;
    d.rms += off * off / static_cast<double>(found.size());
    d.most = std::max(d.most, std::abs(off));
  }
  d.rms = std::sqrt(d.rms);
  return d;
}

}  // namespace

TEST_CASE("A side-lit room at defaults is within one per cent of a converged run", "[daylight][validation]") {
  const DaylitRoom usual = daylit_on(side_lit_room("0.25"), kOvercast, NetworkOptions{});
  const DaylitRoom fine = daylit_on(side_lit_room("0.15"), kOvercast, NetworkOptions{{24, 48}, {96, 192}});
  REQUIRE(usual.zone.points.size() == 90);
  const Difference off = difference(sky_and_ground_lx(usual), sky_and_ground_lx(fine));
  CHECK(off.rms < 0.01);
  CHECK(off.most < 0.02);
}

TEST_CASE("Its 145 coefficients make the overcast sky to half a per cent", "[daylight][validation]") {
  const Zone zone = side_lit_room("0.25");
  const DaylitRoom one = daylit_on(zone, kOvercast, NetworkOptions{});
  const DaylitRoom all = daylit_on(zone, "model = \"tregenza\"\nground = 0.2\n", NetworkOptions{});
  const SkyPatches patches;
  const auto cd_m2 =
      sky_by_patches(Sky(SkyModel::overcast(), {0, 0, 1}, 10000.0), patches).columns_cd_m2(patches, 0.2 * 10000.0 / kPi);
  std::vector<double> lx(zone.points.size(), 0.0);
  for (std::size_t p = 0; p < lx.size(); ++p)
    for (std::size_t k = 0; k < cd_m2.size(); ++k) lx[p] += all.total_lx(p, k) * cd_m2[k];
  const Difference off = difference(lx, sky_and_ground_lx(one));
  CHECK(off.rms < 0.005);
  CHECK(off.most < 0.005);
}
