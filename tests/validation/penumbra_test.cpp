#include <cmath>
#include <random>

#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr double kFloor = -1.5, kPanel = 1.4;
// A wall that stands free at an odd angle, every corner between the floor and the panel in height.
const std::vector<Vec3> kWall = {{-0.1, -1.1, -1.3}, {0.7, 1.3, -1.3}, {0.7, 1.3, 0.1}, {-0.1, -1.1, -0.1}};
const std::vector<Vec3> kOpening = {{-1.9, -0.1, kPanel}, {-0.7, -0.1, kPanel}, {-0.7, 0.5, kPanel}, {-1.9, 0.5, kPanel}};

// Lambert: pi times the configuration factor of a polygon above, at a point of the floor that faces up.
double edge_sum(const std::vector<Vec3>& ring, const Vec3& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 a = glm::normalize(ring[i] - p), b = glm::normalize(ring[(i + 1) % ring.size()] - p);
    const Vec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * across.z / sine;
  }
  return std::abs(sum) / 2.0;
}

double turn(const Vec3& a, const Vec3& b, const Vec3& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// The part of one convex polygon of the panel's plane inside another.
std::vector<Vec3> within(std::vector<Vec3> part, std::vector<Vec3> of) {
  if (turn(of[0], of[1], of[2]) < 0.0) std::reverse(of.begin(), of.end());
  for (std::size_t i = 0; i < of.size() && !part.empty(); ++i) {
    const Vec3 &a = of[i], &b = of[(i + 1) % of.size()];
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec3 &from = part[k], &to = part[(k + 1) % part.size()];
      const double s = turn(a, b, from), t = turn(a, b, to);
      if (s >= 0.0) kept.push_back(from);
      if ((s < 0.0) != (t < 0.0)) kept.push_back(from + s / (s - t) * (to - from));
    }
    part = kept;
  }
  return part;
}

// What the wall leaves of the panel's light: its shadow, thrown from the point onto the panel's plane, cut off.
struct Seen {
  double free = 0.0, visible = 0.0;
};
Seen seen_from(const Vec3& p) {
  std::vector<Vec3> shadow;
  for (const Vec3& corner : kWall) shadow.push_back(p + (kPanel - p.z) / (corner.z - p.z) * (corner - p));
  const auto hidden = within(kOpening, shadow);
  const double free = edge_sum(kOpening, p);
  return {free, free - (hidden.size() > 2 ? edge_sum(hidden, p) : 0.0)};
}

struct Errors {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double e) {
    ++n;
    sum += e;
    squares += e * e;
  }
};

// In ten bins of the visible share, errors in shares of the unobstructed light.
struct Bins {
  std::array<Errors, 10> bins;
  Errors all;
  void add(const Seen& right, double found) {
    const double share = right.visible / right.free;
    if (share < 1e-9 || share > 1.0 - 1e-9) return;
    const double error = found / right.free - share;
    bins[std::min<std::size_t>(9, static_cast<std::size_t>(share * 10.0))].add(error);
    all.add(error);
  }
  double rms() const { return std::sqrt(all.squares / all.n); }
};

Zone room() {
  Zone zone = box_zone({8, 5, 3}, 0.0, 0.25);
  add_surface(zone, "wall", kWall, add_grey(zone, 0.0), 0.5);
  zone.surfaces.back().bounding = false;
  return zone;
}

// 1 cd/m2: illuminance is the projected solid angle.
Lights panel() {
  Lights lights;
  add_lamp(lights, "panel", {-1.3, 0.2, kPanel}, IntensityTable::lambertian(1.2 * 0.6), {.opening = rectangle(1.2, 0.6)});
  return lights;
}

}  // namespace

TEST_CASE("Points in a penumbra are right in every bin of the visible share, and more so the more is asked",
          "[direct][validation]") {
  Zone zone = room();
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 6000; ++i)
    zone.points.push_back({{0.3 + 3.4 * unit(random), -2.0 + 4.0 * unit(random), kFloor}, {0, 0, 1}});
  const Network network = network_of(zone);
  const auto errors_at = [&](double tolerance) {
    SimulationOptions options;
    options.gather.tolerance = tolerance;
    const auto solution = solve(zone, panel(), network, options);
    Bins result;
    for (std::size_t p = 0; p < zone.points.size(); ++p)
      result.add(seen_from(zone.points[p].position), static_cast<double>(solution.point_direct[p]));
    return result;
  };
  const Bins usual = errors_at(3e-4), fine = errors_at(3e-5);
  CHECK(usual.all.n > 1500);
  CHECK(usual.rms() < 3e-3);
  CHECK(fine.rms() < 0.5 * usual.rms());
  for (const Errors& bin : usual.bins) CHECK(std::abs(bin.sum / bin.n) < 2e-4);
}

TEST_CASE("Cells in a penumbra are right in every bin of the visible share", "[direct][validation]") {
  constexpr int kAcross = 24;  // points of a cell to know its mean by
  const Zone zone = room();
  const Cells cells(zone);
  const Lights lights = panel();
  const auto direct = direct_light(zone, cells, lights, {0}, 1, Job{});
  Bins errors;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    Ring2 ring;
    cells.outline(i, ring);
    const Frame& frame = zone.surfaces[0].polygon.frame();
    if (frame.to_world(ring[0]).x < 0.4) continue;  // the wall stands over these
    Seen mean;
    for (int u = 0; u < kAcross; ++u) {
      for (int v = 0; v < kAcross; ++v) {
        const Vec2 at = ring[0] + (u + 0.5) / kAcross * (ring[1] - ring[0]) + (v + 0.5) / kAcross * (ring[3] - ring[0]);
        const Seen seen = seen_from(frame.to_world(at));
        mean.free += seen.free / (kAcross * kAcross);
        mean.visible += seen.visible / (kAcross * kAcross);
      }
    }
    errors.add(mean, direct.cell_lx[i]);
  }
  CHECK(errors.all.n > 40);
  CHECK(errors.rms() < 3e-3);
  CHECK(std::abs(errors.all.sum / errors.all.n) < 3.0 * errors.rms() / std::sqrt(errors.all.n) + 2e-4);
}
