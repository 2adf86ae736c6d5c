#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

TEST_CASE("In a closed room all light is received on its first flight", "[transport][unit]") {
  const Zone zone = furnished_room(0.5, 0.5);
  Lights lights = point_lamp({0, 0, 1}, 100.0);
  const auto flight = flights_of(zone, lights, 4096)[0];
  CHECK(flight.received == 1.0);
  CHECK(flight.escaped == 0.0);
  CHECK(flight.lost == 0.0);
  CHECK(flight.flux_lm == Approx(400.0 * kPi).epsilon(1e-12));
}

TEST_CASE("Through an open ceiling goes the share of its solid angle", "[transport][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  zone.surfaces.erase(zone.surfaces.begin() + 1);
  constexpr int kRays = 16384;
  const auto flight = flights_of(zone, point_lamp({0.3, 0.2, -0.1}, 10.0), kRays)[0];
  const double share = solid_angle_sr({-2.3, -1.7}, {1.7, 1.3}, 1.1) / (4 * kPi);
  // Four standard deviations of as many random rays; low-discrepancy ones do better.
  const double sigma = std::sqrt(share * (1 - share) / kRays);
  CHECK(flight.escaped == Approx(share).margin(4 * sigma));
  CHECK(flight.received == Approx(1 - share).margin(4 * sigma));
  CHECK(flight.lost == 0.0);
}

TEST_CASE("A lamp inside a box loses all its light on backs", "[transport][unit]") {
  const Zone zone = furnished_room(0.5, 0.5);
  const auto flight = flights_of(zone, point_lamp({2.5, 1.0, -0.5}, 10.0), 1024)[0];
  CHECK(flight.lost == 1.0);
}

TEST_CASE("A Lambertian panel's sampled flux is pi I and a dark one's nothing", "[transport][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0.99}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(0.6, 0.6), .factor = 0.5});
  add_lamp(lights, "off", {0, 0, 0}, IntensityTable::isotropic(0.0));
  const auto flights = flights_of(zone, lights, 16384);
  // Half the rays carry cos(gamma), mean 1/4 over the sphere, variance 1/6 - 1/16: sd 0.32/128 of 0.25.
  CHECK(flights[0].flux_lm == Approx(50.0 * kPi).epsilon(4 * 0.0101));
  CHECK(flights[1].flux_lm == 0.0);
  CHECK(flights[1].received + flights[1].escaped + flights[1].lost == 0.0);
}

TEST_CASE("A body takes the light that its own opening sends backwards", "[transport][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0}, IntensityTable::isotropic(1.0),
           {.opening = rectangle(0.6, 0.6), .body = true});
  const auto flight = flights_of(zone, lights, 16384)[0];
  // Upward half, but for rays from within 0.1 mm of the edge.
  CHECK(flight.lost == Approx(0.5).margin(0.01));
  CHECK(flight.received == Approx(0.5).margin(0.01));
}
