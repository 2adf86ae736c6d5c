// Blinds' laws by irradiance, illuminance and direct sun against what is worked out by hand for a south facade.
#include "catch.hpp"
#include "climate/blinds.hpp"
#include "result/database.hpp"
#include "sky/direction.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr double kGround = 0.3;

// A box with a window to the south, three points on its floor, and what stands outside.
LuminanceDatabase south_room(const std::string& outside = "") {
  std::string text =
      box_text({4, 6, 3}, 0.3,
               "[[surface]]\nname = \"w\"\non = \"wall-s\"\nfinish = \"pane\"\ngroup = \"south\"\n"
               "states = { shut = \"blind\" }\nvertices = [[3.5,0,0.9],[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7]]\n"
               "[[sensors]]\nname = \"p\"\npoints = [[2,1.8,0, 0,0,1],[2,0.5,0, 0,0,1],[2,3.2,0, 0,0,1]]\n" +
                   outside,
               1.0);
  text.replace(text.find("[finishes]\n"), 11,
               "[finishes]\nblind = { kind = \"glazing\", transmittance = 0.1, angular_law = \"diffusing\" }\n");
  const Zone zone = read(text);
  Warnings warnings;
  const Lights lights = read_lights("dim = \"lights/1\"\n[sky]\nmodel = \"tregenza\"\nground = " + std::to_string(kGround),
                                    "lights.toml", {}, zone, {}, warnings);
  const Cells cells(zone);
  NetworkOptions options;
  options.patches = options.point_patches = {4, 8};
  const Network network = build_network(zone, cells, options, Job{});
  return {zone, cells, lights, simulate(zone, cells, network, lights, {}, Job{}, warnings)};
}

// One moment: an even sky, the ground that it and the sun light, the sun.
struct Moment {
  double sun_altitude_deg, sun_azimuth_deg;
  Irradiance irradiance;
  double sky_horizontal_lx, sun_normal_lx;

  Vec3 sun() const { return sky_direction(radians(sun_altitude_deg), radians(sun_azimuth_deg)); }
  double on_level(double sky, double beam) const { return sky + beam * sun().z; }
  // Half of what a facade sees is sky, half is ground; it faces -y.
  double on_facade(double sky, double beam) const {
    return 0.5 * sky + 0.5 * kGround * on_level(sky, beam) + beam * std::max(0.0, -sun().y);
  }

  AnnualSky sky() const {
    AnnualSky sky(1);
    sky.n_steps = 1;
    sky.lit = {0};
    sky.luminance_cd_m2.assign(sky.patches.n_columns(), 0.0F);
    for (std::size_t p = 0; p < sky.patches.size(); ++p)
      sky.luminance_cd_m2[p] = static_cast<float>(sky_horizontal_lx / kPi);
    sky.luminance_cd_m2[sky.patches.ground()] =
        static_cast<float>(kGround * on_level(sky_horizontal_lx, sun_normal_lx) / kPi);
    sky.sun = {sun()};
    sky.sun_normal_lx = {sun_normal_lx};
    sky.irradiance = {irradiance};
    sky.sky_horizontal_lx = {sky_horizontal_lx};
    return sky;
  }
};

const Moment kNoon{45.0, 180.0, {600.0, 150.0}, 18000.0, 60000.0};
const Moment kSideways{20.0, 250.0, {400.0, 80.0}, 9000.0, 35000.0};
const Moment kFromNorth{10.0, 60.0, {200.0, 60.0}, 7000.0, 15000.0};

bool closed(const LuminanceDatabase& room, const Moment& moment, BlindPlan plan) {
  plan.windows = "south";
  plan.closed = "shut";
  return operate(room, {}, {plan}, moment.sky()).blinds.at(0).closed.at(0);
}

BlindPlan by_level(BlindLaw law, double level) {
  BlindPlan plan;
  plan.law = law;
  plan.close_above = plan.open_below = level;
  return plan;
}

// Whether a law closes just below a value and not just above it.
void check_turns_at(const LuminanceDatabase& room, const Moment& moment, BlindLaw law, double value) {
  constexpr double kMargin = 0.005;
  CAPTURE(moment.sun_azimuth_deg, value);
  CHECK(closed(room, moment, by_level(law, (1.0 - kMargin) * value)));
  CHECK_FALSE(closed(room, moment, by_level(law, (1.0 + kMargin) * value)));
}

}  // namespace

TEST_CASE("Blinds close at the illuminance of the outer face", "[daylight][climate][validation]") {
  const auto room = south_room();
  for (const Moment& moment : {kNoon, kSideways, kFromNorth})
    check_turns_at(room, moment, BlindLaw::illuminance,
                   moment.on_facade(moment.sky_horizontal_lx, moment.sun_normal_lx));
}

TEST_CASE("Blinds close at the irradiance of the outer face", "[daylight][climate][validation]") {
  const auto room = south_room();
  for (const Moment& moment : {kNoon, kSideways, kFromNorth})
    check_turns_at(room, moment, BlindLaw::irradiance,
                   moment.on_facade(moment.irradiance.diffuse_horizontal_W_m2, moment.irradiance.direct_normal_W_m2));
}

TEST_CASE("A canopy keeps the sun from the outer face", "[daylight][climate][validation]") {
  // Ten metres deep and wide, 3 m up: at 45 degrees all sun and nearly all sky is gone; half of the ground stays.
  const auto room = south_room(
      "[[surface]]\nname = \"canopy\"\nfinish = \"grey\"\noutside = true\n"
      "vertices = [[-8,-10,3],[-8,0,3],[12,0,3],[12,-10,3]]\n");
  const double ground_lx = 0.5 * kGround * kNoon.on_level(kNoon.sky_horizontal_lx, kNoon.sun_normal_lx);
  CHECK(closed(room, kNoon, by_level(BlindLaw::illuminance, 0.99 * ground_lx)));
  CHECK_FALSE(closed(room, kNoon, by_level(BlindLaw::illuminance, ground_lx + 0.1 * kNoon.sky_horizontal_lx)));
}

TEST_CASE("Blinds close against direct sun on more than a share of the points", "[daylight][climate][validation]") {
  // The sun meets the first of three points, through glass that passes two thirds of it at 45 degrees.
  const auto room = south_room();
  const double lx = 60000.0 * std::sqrt(0.5);
  BlindPlan plan;
  plan.most_sun_lx = 0.65 * lx;
  plan.most_points = 0.33;
  CHECK(closed(room, kNoon, plan));
  plan.most_points = 0.34;
  CHECK_FALSE(closed(room, kNoon, plan));
  plan.most_points = 0.33;
  plan.most_sun_lx = 0.7 * lx;
  CHECK_FALSE(closed(room, kNoon, plan));
  CHECK_FALSE(closed(room, kFromNorth, BlindPlan{}));
}
