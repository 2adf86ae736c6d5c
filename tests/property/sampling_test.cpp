// What is drawn at random against its density: chi-square, as nori and pbrt test their samplers.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "catch.hpp"
#include "geometry/area_sampler.hpp"
#include "geometry/convex_ring.hpp"
#include "hemisphere/patches.hpp"
#include "photometry/intensity.hpp"
#include "photometry/opening.hpp"

using namespace dim;

namespace {

constexpr int kDraws = 200000;

class Unit {
 public:
  double operator()() { return uniform_(random_); }
  Vec2 two() {
    const double a = (*this)();
    return {a, (*this)()};
  }

 private:
  std::mt19937_64 random_{17};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

// Bins of two coordinates, each within [0, 1).
struct Bins {
  int n_x, n_y;
  std::vector<double> count = std::vector<double>(static_cast<std::size_t>(n_x * n_y), 0.0);
  std::size_t of(const Vec2& at) const {
    const int x = std::clamp(static_cast<int>(at.x * n_x), 0, n_x - 1);
    const int y = std::clamp(static_cast<int>(at.y * n_y), 0, n_y - 1);
    return static_cast<std::size_t>(x * n_y + y);
  }
  void add(const Vec2& at, double weight = 1.0) { count[of(at)] += weight; }
};

// Mean n - 1, variance 2 (n - 1): five standard deviations.
void check_chi_square(const std::vector<double>& drawn, const std::vector<double>& expected) {
  double chi2 = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (expected[i] == 0.0) REQUIRE(drawn[i] == 0.0);
    if (expected[i] < 5.0) continue;
    chi2 += std::pow(drawn[i] - expected[i], 2) / expected[i];
    ++n;
  }
  REQUIRE(n > 20);
  CAPTURE(n, chi2);
  CHECK(chi2 < n - 1 + 5.0 * std::sqrt(2.0 * (n - 1)));
  CHECK(chi2 > n - 1 - 5.0 * std::sqrt(2.0 * (n - 1)));
}

std::vector<double> even(const Bins& bins) {
  return std::vector<double>(bins.count.size(),
                             static_cast<double>(kDraws) / static_cast<double>(bins.count.size()));
}

double turn_of(const Vec2& v) {
  const double turn = std::atan2(v.y, v.x) / (2.0 * kPi);
  return turn < 0.0 ? turn + 1.0 : turn;
}

// A plane region's share of each bin of its bounding square of side 2: midpoints.
std::vector<double> shares(const Bins& bins, const std::function<bool(const Vec2&)>& inside) {
  Bins fine{bins.n_x, bins.n_y};
  constexpr int kFine = 1400;
  double total = 0.0;
  for (int i = 0; i < kFine; ++i) {
    for (int j = 0; j < kFine; ++j) {
      const Vec2 at((i + 0.5) / kFine, (j + 0.5) / kFine);
      if (!inside(2.0 * at - 1.0)) continue;
      fine.add(at);
      total += 1.0;
    }
  }
  for (double& count : fine.count) count *= kDraws / total;
  return fine.count;
}

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

bool within(const Ring2& convex, const Vec2& p) {
  for (std::size_t i = 0; i < convex.size(); ++i)
    if (cross(convex[(i + 1) % convex.size()] - convex[i], p - convex[i]) < 0.0) return false;
  return true;
}

}  // namespace

TEST_CASE("Openings are sampled evenly", "[photometry][property]") {
  Unit unit;
  Bins bins{11, 13};
  SECTION("a rectangle") {
    const LuminousOpening opening{OpeningShape::kRectangle, 1.2, 0.3, 0.0};
    for (int i = 0; i < kDraws; ++i) {
      const Vec3 p = sample(opening, unit.two());
      REQUIRE(p.z == 0.0);
      bins.add({p.x / 1.2 + 0.5, p.y / 0.3 + 0.5});
    }
  }
  SECTION("an ellipse") {
    const LuminousOpening opening{OpeningShape::kEllipse, 1.2, 0.3, 0.0};
    for (int i = 0; i < kDraws; ++i) {
      const Vec3 p = sample(opening, unit.two());
      const Vec2 round(p.x / 0.6, p.y / 0.15);
      REQUIRE(glm::dot(round, round) <= 1.0 + 1e-12);
      bins.add({glm::dot(round, round), turn_of(round)});
    }
  }
  SECTION("an upright ellipse") {
    const LuminousOpening opening{OpeningShape::kVerticalEllipse, 0.0, 0.5, 0.8};
    for (int i = 0; i < kDraws; ++i) {
      const Vec3 p = sample(opening, unit.two());
      REQUIRE(p.x == 0.0);
      const Vec2 round(p.y / 0.25, p.z / 0.4);
      bins.add({glm::dot(round, round), turn_of(round)});
    }
  }
  check_chi_square(bins.count, even(bins));
}

TEST_CASE("Patches together send rays as the cosine has it", "[hemisphere][property]") {
  // A patch by its weight, a direction in it: cos^2 and the turn are uniform.
  const PatchGrid grid = GENERATE(PatchGrid{16, 32}, PatchGrid{3, 5});
  Unit unit;
  Bins bins{23, 17};
  for (int i = 0; i < kDraws; ++i) {
    const double cos2 = unit(), turn = unit();
    // A slice holds the square of its edges' cosines.
    const int slice = std::min(grid.n_slices - 1, static_cast<int>(std::sqrt(cos2) * grid.n_slices));
    const int sector = std::min(grid.n_sectors - 1, static_cast<int>(turn * grid.n_sectors));
    const Vec3 d = grid.direction(slice, sector, unit(), unit());
    REQUIRE(std::abs(glm::length(d) - 1.0) < 1e-11);  // sine and cosine of a turn are good to some 1e-12
    bins.add({d.z * d.z, turn_of({d.x, d.y})});
  }
  check_chi_square(bins.count, even(bins));
}

TEST_CASE("Cells of any shape are sampled evenly", "[geometry][property]") {
  const Ring2 pentagon = {{-0.9, -0.7}, {0.2, -0.95}, {0.95, -0.1}, {0.4, 0.85}, {-0.6, 0.6}};
  Unit unit;
  Bins bins{14, 14};
  std::vector<double> expected = shares(bins, [&](const Vec2& p) { return within(pentagon, p); });
  SECTION("by trapezoids") {
    const AreaSampler area({pentagon});
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 x = unit.two();
      bins.add((area.point(x.x, x.y) + 1.0) / 2.0);
    }
  }
  SECTION("by triangles") {
    ConvexRing ring;
    for (const Vec2& p : pentagon) ring.add(Vec3(p, 0.3));
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 x = unit.two();
      bins.add((Vec2(ring.sample(x.x, x.y)) + 1.0) / 2.0);
    }
  }
  SECTION("with a notch and a hole") {
    const Ring2 notched = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.1}, {0.2, 0.3}, {0.4, 0.9}, {-0.9, 0.8}};
    const Ring2 hole = {{-0.6, -0.5}, {-0.4, 0.2}, {0.1, -0.3}};
    const Ring2 low = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.1}, {0.2, 0.3}},
                high = {{0.2, 0.3}, {0.4, 0.9}, {-0.9, 0.8}}, left = {{-0.9, -0.9}, {0.2, 0.3}, {-0.9, 0.8}},
                hole_round = {hole[0], hole[2], hole[1]};
    expected = shares(bins, [&](const Vec2& p) {
      return (within(low, p) || within(high, p) || within(left, p)) && !within(hole_round, p);
    });
    const AreaSampler area({notched, hole});
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 x = unit.two();
      bins.add((area.point(x.x, x.y) + 1.0) / 2.0);
    }
  }
  // Bins that an edge cuts are known to the midpoints' share of them, 1 in 5,000 or so: less than chance.
  for (std::size_t b = 0; b < expected.size(); ++b)
    if (expected[b] < 5.0) expected[b] = std::max(expected[b], 1e-9);
  check_chi_square(bins.count, expected);
}

TEST_CASE("Light leaves a fitting as its intensity table has it", "[photometry][property]") {
  // Different in every plane, and a beam of two degrees beside a wide one.
  std::vector<double> c, gamma, cd;
  for (int i = 0; i <= 6; ++i) c.push_back(i * kPi / 3);
  for (const double deg : {0.0, 1.0, 2.0, 5.0, 20.0, 45.0, 70.0, 95.0, 130.0}) gamma.push_back(radians(deg));
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t g = 0; g < gamma.size(); ++g)
      cd.push_back(g < 3 ? 5000.0
                         : 100.0 * (1.0 + static_cast<double>(i % 6)) * (g + 1 < gamma.size() ? 1.0 : 0.0));
  const IntensityTable table({c, gamma, cd});
  constexpr int kFine = 200;
  Unit unit;
  Bins bins{19, 12}, squares{19, 12}, expected{19, 12};
  const double most = radians(130.0);
  for (int x = 0; x < bins.n_x * kFine; ++x) {
    for (int y = 0; y < bins.n_y * 20; ++y) {
      const Vec2 at((x + 0.5) / (bins.n_x * kFine), (y + 0.5) / (bins.n_y * 20));
      const double solid_angle =
          std::sin(at.x * most) * most / (bins.n_x * kFine) * 2.0 * kPi / (bins.n_y * 20);
      expected.add(at, table.at_c_gamma(2.0 * kPi * at.y, at.x * most) * solid_angle / table.flux_lm());
    }
  }
  for (int i = 0; i < kDraws; ++i) {
    const Vec2 x = unit.two();
    const auto emission = table.emission(x.x, x.y);
    const Vec2 at(std::acos(std::clamp(emission.direction.z, -1.0, 1.0)) / most,
                  turn_of({emission.direction.x, emission.direction.y}));
    bins.add(at, emission.weight);
    squares.add(at, emission.weight * emission.weight);
  }
  double chi2 = 0.0;
  for (std::size_t b = 0; b < bins.count.size(); ++b) {
    const double share = bins.count[b] / kDraws;
    const double variance = (squares.count[b] / kDraws - share * share) / kDraws;
    chi2 += std::pow(share - expected.count[b], 2) / variance;
  }
  const double n = static_cast<double>(bins.count.size());
  CAPTURE(chi2, n);
  CHECK(chi2 < n + 5.0 * std::sqrt(2.0 * n));
  CHECK(chi2 > n - 5.0 * std::sqrt(2.0 * n));
}
