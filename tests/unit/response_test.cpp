// What measuring points of each quantity make of light: closed forms of small bodies.
#include <array>

#include "catch.hpp"
#include "hemisphere/response.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr std::array kBodies = {Quantity::cylindrical, Quantity::semicylindrical, Quantity::hemispherical,
                                Quantity::scalar};

Vec3 normal_for(Quantity quantity) {
  return quantity == Quantity::semicylindrical ? Vec3(0.6, 0.8, 0) : Vec3(0, 0, 1);
}

// A piece of a body's surface.
struct Facet {
  Vec3 normal;
  double share;
};

// The surface of a small body in flat pieces: the mean of their planar illuminances is its quantity.
std::vector<Facet> facets_of(const Response& response, int n) {
  std::vector<Facet> facets;
  const Vec3 front = response.normal, left(-front.y, front.x, 0.0);
  const bool half = response.quantity == Quantity::semicylindrical;
  if (half || response.quantity == Quantity::cylindrical) {
    for (int i = 0; i < n; ++i) {
      const double turn = half ? kPi * ((i + 0.5) / n - 0.5) : 2.0 * kPi * (i + 0.5) / n;
      const Vec3 normal = half ? std::cos(turn) * front + std::sin(turn) * left
                               : Vec3(std::cos(turn), std::sin(turn), 0.0);
      facets.push_back({normal, 1.0 / n});
    }
    return facets;
  }
  const double lowest = response.quantity == Quantity::scalar ? -1.0 : 0.0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double z = lowest + (1.0 - lowest) * (i + 0.5) / n, turn = 2.0 * kPi * (k + 0.5) / n;
      const double r = std::sqrt(1.0 - z * z);
      facets.push_back({{r * std::cos(turn), r * std::sin(turn), z}, 1.0 / n / n});
    }
  return facets;
}

Vec3 any_direction(std::mt19937_64& random) {
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  Vec3 d(within(random), within(random), within(random));
  while (glm::length(d) > 1.0 || glm::length(d) < 0.1) d = {within(random), within(random), within(random)};
  return glm::normalize(d);
}

bool is_upright(Quantity quantity) {
  return quantity == Quantity::cylindrical || quantity == Quantity::semicylindrical;
}

MeasuringPoint point_of(Quantity quantity, const Vec3& position) {
  return {position, normal_for(quantity), true, quantity};
}

}  // namespace

TEST_CASE("A response is the mean of the planar illuminances over the body's surface", "[response][unit]") {
  std::mt19937_64 random(11);
  for (const Quantity quantity : kBodies) {
    const Response response{normal_for(quantity), quantity};
    const auto facets = facets_of(response, 600);
    for (int i = 0; i < 20; ++i) {
      const Vec3 beam = any_direction(random);
      double mean = 0.0;
      for (const auto& facet : facets) mean += facet.share * std::max(0.0, glm::dot(facet.normal, beam));
      INFO(quantity_word(quantity));
      CHECK(response.of(beam) == Approx(mean).epsilon(2e-5).margin(2e-6));
      CHECK(response.of(3.5 * beam) == Approx(3.5 * response.of(beam)).epsilon(1e-12));
    }
  }
}

TEST_CASE("Responses add up to pi over the sphere, and over half of it to their closed forms", "[response][unit]") {
  // Even luminance L from above alone: cylinders and the sphere get pi L / 2, the dome 3 pi L / 4.
  for (const Quantity quantity : kBodies) {
    const Response response{normal_for(quantity), quantity};
    double above = 0.0, below = 0.0;
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const double z = (i + 0.5) / kSteps, r = std::sqrt(1.0 - z * z), turn = 2.0 * kPi * (k + 0.5) / kSteps;
        const Vec3 d(r * std::cos(turn), r * std::sin(turn), z);
        above += response.of(d) * 2.0 * kPi / kSteps / kSteps;
        below += response.of({d.x, d.y, -d.z}) * 2.0 * kPi / kSteps / kSteps;
      }
    INFO(quantity_word(quantity));
    CHECK(above + below == Approx(kPi).epsilon(1e-4));
    CHECK(above == Approx(quantity == Quantity::hemispherical ? 0.75 * kPi : 0.5 * kPi).epsilon(1e-4));
  }
}

TEST_CASE("Directions of a response are spread as its weight is", "[response][property]") {
  // Moments of the spread against integrals of the response over the sphere.
  constexpr int kSteps = 400;
  for (const Quantity quantity : {Quantity::planar, Quantity::cylindrical, Quantity::semicylindrical,
                                  Quantity::hemispherical, Quantity::scalar}) {
    const MeasuringPoint point = point_of(quantity, {0, 0, 0});
    const Frame frame = frame_at(point);
    const auto moments = [](const Vec3& d) {
      return std::array{d.x, d.y, d.z, d.x * d.x, d.y * d.y, d.x * d.y, d.x * d.x * d.x, d.y * d.y * d.y, d.z * d.z * d.z};
    };
    std::array<double, 9> spread{}, weighted{};
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const Vec3 d = frame.direction_to_world(response_direction(quantity, (i + 0.5) / kSteps, (k + 0.5) / kSteps));
        CHECK(glm::length(d) == Approx(1.0).epsilon(1e-9));
        const double z = 2.0 * (i + 0.5) / kSteps - 1.0, r = std::sqrt(1.0 - z * z), turn = 2.0 * kPi * (k + 0.5) / kSteps;
        const Vec3 even(r * std::cos(turn), r * std::sin(turn), z);
        const auto at_d = moments(d), at_even = moments(even);
        for (std::size_t m = 0; m < spread.size(); ++m) {
          spread[m] += at_d[m] / kSteps / kSteps;
          weighted[m] += at_even[m] * point.response().of(even) * 4.0 / kSteps / kSteps;
        }
      }
    INFO(quantity_word(quantity));
    for (std::size_t m = 0; m < spread.size(); ++m) CHECK(spread[m] == Approx(weighted[m]).margin(3e-4));
  }
}

TEST_CASE("A point source lights every body as its closed form has it", "[response][direct][unit]") {
  Zone zone = box_zone({40, 40, 40}, 0.0, 40.0);
  const Vec3 at(0.3, -0.2, 1.0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-15.0, 15.0);
  for (int i = 0; i < 60; ++i)
    for (const Quantity quantity : kBodies)
      zone.points.push_back(point_of(quantity, {within(random), within(random), within(random)}));
  for (const Quantity quantity : kBodies) {
    zone.points.push_back(point_of(quantity, at + Vec3(0, 0, 2.0)));
    zone.points.push_back(point_of(quantity, at - Vec3(0, 0, 2.0)));
    zone.points.push_back(point_of(quantity, at));
  }
  const auto light = test::direct(zone, point_lamp(at, 250.0));
  for (std::size_t i = 0; i + 3 * kBodies.size() < zone.points.size(); ++i) {
    const MeasuringPoint& point = zone.points[i];
    const Vec3 d = glm::normalize(at - point.position);
    const double r2 = glm::dot(at - point.position, at - point.position), sine = std::hypot(d.x, d.y);
    const double weight = point.quantity == Quantity::cylindrical       ? sine / kPi
                          : point.quantity == Quantity::semicylindrical ? (sine + 0.6 * d.x + 0.8 * d.y) / kPi
                          : point.quantity == Quantity::hemispherical   ? (1.0 + d.z) / 4.0
                                                                        : 0.25;
    CHECK(light.point_lx[i] == Approx(250.0 * weight / r2).epsilon(1e-12).margin(1e-15));
  }
  for (const double lx : light.point_lx) CHECK(std::isfinite(lx));
}

TEST_CASE("A Lambertian panel lights every body as its own surface would be", "[response][direct][unit]") {
  // Lambert's formula for each piece of the body's surface, the panel cut by that piece's horizon.
  Lights lights;
  const auto lamp = add_lamp(lights, "panel", {0.5, 0.2, 0.1}, IntensityTable::lambertian(80.0),
                             {.aim = {0.3, -0.2, -1}, .opening = rectangle(1.0, 0.4)});
  const Vec3 a = lamp.c0 * 0.5, b = lamp.c90 * 0.2;
  ConvexRing panel;
  for (const Vec3& corner : {lamp.at - a - b, lamp.at + a - b, lamp.at + a + b, lamp.at - a + b}) panel.add(corner);
  Zone zone = box_zone({40, 40, 40}, 0.0, 40.0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (int i = 0; i < 24; ++i) {
    Vec3 p = lamp.at + 2.0 * Vec3(within(random), within(random), within(random));
    const double height = glm::dot(p - lamp.at, lamp.aim);
    p += (std::abs(height) + 0.05 - height) * lamp.aim;  // before it
    for (const Quantity quantity : kBodies) zone.points.push_back(point_of(quantity, p));
  }
  const auto light = test::direct(zone, lights);
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const MeasuringPoint& point = zone.points[i];
    double mean = 0.0;
    for (const auto& facet : facets_of(point.response(), is_upright(point.quantity) ? 4000 : 150)) {
      const ConvexRing seen = panel.front_of(facet.normal, glm::dot(facet.normal, point.position));
      if (seen.size() < 3) continue;
      mean += facet.share * lambert_lx(point.position, facet.normal, Ring3(seen.begin(), seen.end()), 80.0 / 0.4);
    }
    INFO(quantity_word(point.quantity) << " at " << point.position.x << " " << point.position.y << " " << point.position.z);
    CHECK(light.point_lx[i] == Approx(mean).epsilon(5e-4));
  }
}

TEST_CASE("In a furnace every quantity is the planar illuminance", "[response][validation]") {
  // A closed grey room with luminous flux everywhere alike has E = Phi / (A (1 - rho)) whatever is measured: its
  // inter-reflected part is even where the direct light is.
  Zone zone = box_zone({4, 3, 2.5}, 0.5, 0.5);
  zone.closed = true;
  for (const Quantity quantity : kBodies) zone.points.push_back(point_of(quantity, {0.7, -0.4, 0.3}));
  zone.points.push_back({{0.7, -0.4, 0.3}, glm::normalize(Vec3(1, 2, 3))});
  const Cells cells(zone);
  const Network network = network_of(zone, {16, 32});
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < network.point_patches.n_patches(); ++k) {
      CHECK(network.point_sinks.at(p, k) < cells.size());
      sum += network.point_patches.weight_sr(static_cast<int>(k / 32));
    }
    CHECK(sum == Approx(kPi).epsilon(1e-12));
  }
}
