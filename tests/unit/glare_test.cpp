// Glare against closed forms.
#include <limits>

#include "catch.hpp"
#include "glare/observers.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const LineOfSight kAhead = LineOfSight::along({1, 0, 0});

double position(double above, double aside) { return position_index({1.0, aside, above}, kAhead); }

// The curve of the paper, written down a second time: degrees.
double levin(double sigma, double tau) {
  const double first = 35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 / 9.0 * tau);
  const double second = 21.0 + 0.26667 * tau - 0.002963 * tau * tau;
  return std::exp(first * sigma / 1e3 + second * sigma * sigma / 1e5);
}

// A database of a room whose cells all have this illuminance, and one lamp.
LuminanceDatabase uniform_database(const Zone& zone, const Lights& lights, double illuminance_lx) {
  const Cells cells(zone);
  Solution solution;
  Source source;
  source.name = source.group = "lamp";
  source.luminaires = {"lamp"};
  source.flux_lm = 1.0;
  source.weights = band_weights(SpectralCurve(1.0), Bands{});
  solution.sources = {source};
  solution.classes = classify(zone, solution.bands);
  solution.n_cells = cells.size();
  solution.cell_direct.assign(cells.size(), 0.0F);
  solution.cell_total.assign(cells.size(), static_cast<float>(illuminance_lx));
  return {zone, cells, lights, std::move(solution)};
}

}  // namespace

TEST_CASE("Guth's position index is 1 straight ahead and grows as the curves do", "[glare][unit]") {
  CHECK(position(0, 0) == Approx(1.0));
  for (const double t : {0.0, 0.3, 1.0, 2.0}) {
    for (const double h : {0.1, 0.5, 1.0, 1.9}) {
      const double sigma = degrees(std::acos(1.0 / std::sqrt(1.0 + t * t + h * h))),
                   tau = degrees(std::atan2(t, h));
      CHECK(position(h, t) == Approx(levin(sigma, tau)).epsilon(1e-12));
      CHECK(position(h, -t) == position(h, t));
    }
  }
  // CIE 117, table of position indices, T/R = 0.
  CHECK(position(0.5, 0) == Approx(2.86).epsilon(0.01));
  CHECK(position(1.0, 0) == Approx(7.00).epsilon(0.01));
  CHECK(position(1.5, 0) == Approx(13.15).epsilon(0.01));
  CHECK(position(-0.5, 0) == Approx(1.4));
  CHECK(position(-1.0, 0) == Approx(2.2));
  CHECK(position(-50.0, 2.0) == Approx(4.6));
}

TEST_CASE("What is behind the eye or far aside has no position index", "[glare][unit]") {
  const double none = std::numeric_limits<double>::infinity();
  CHECK(position_index({-1, 0, 1}, kAhead) == none);
  CHECK(position_index({0, 1, 0}, kAhead) == none);
  CHECK(position(0.5, 3.01) == none);
  CHECK(position(0.5, 2.99) < none);
}

TEST_CASE("An eye turned with the room sees the same", "[glare][unit]") {
  const auto turned = LineOfSight::along({0, 0, -1}, {0, 1, 0});
  CHECK(position_index({0.2, 0.3, -1.0}, turned) == Approx(position(0.3, 0.2)).epsilon(1e-12));
  const auto down = LineOfSight::along({0, 0, -1});  // +y is up then
  CHECK(down.up.y == Approx(1.0));
}

TEST_CASE("UGR of one source is 8 lg (L^2 omega / 4 p^2 Lb)", "[glare][unit]") {
  const GlareSource source{{1, 0, 0.5}, 5000.0, 0.01};
  const double p = position(0.5, 0);
  const auto rating = unified_glare_rating({&source, 1}, 40.0, kAhead);
  CHECK(rating.ugr == Approx(8.0 * std::log10(0.25 / 40.0 * 25e6 * 0.01 / (p * p))));
  CHECK(rating.n_sources == 1);
  const std::vector<GlareSource> ten(10, source);
  CHECK(unified_glare_rating(ten, 40.0, kAhead).ugr == Approx(rating.ugr + 8.0));
  CHECK(std::isnan(unified_glare_rating({}, 40.0, kAhead).ugr));
  CHECK(std::isnan(unified_glare_rating({&source, 1}, 0.0, kAhead).ugr));
}

TEST_CASE("Small sources count by 200 I^2 / r^2, large ones are told", "[glare][unit]") {
  const GlareSource small = glare_source({1, 0, 0}, 300.0, 0.001, 4.0);
  CHECK(small.luminance_cd_m2 * small.luminance_cd_m2 * small.solid_angle_sr ==
        Approx(200.0 * 300.0 * 300.0 / 16.0));
  const GlareSource point = glare_source({1, 0, 0}, 300.0, 0.0, 4.0);
  CHECK(point.solid_angle_sr == small.solid_angle_sr);
  const GlareSource large = glare_source({1, 0, 0}, 300.0, 2.0, 4.0);
  CHECK(large.luminance_cd_m2 == Approx(150.0));
  CHECK(large.solid_angle_sr == Approx(0.125));
  CHECK(unified_glare_rating({&large, 1}, 10.0, kAhead).n_large == 1);
  CHECK(unified_glare_rating({&small, 1}, 10.0, kAhead).n_large == 0);
}

TEST_CASE("A ceiling of small sources glares as the sum over it says", "[glare][unit]") {
  std::vector<GlareSource> sources;
  double sum = 0.0;
  for (int i = -20; i <= 20; ++i) {
    for (int j = 0; j < 40; ++j) {
      const double x = 0.3 * (j + 0.5), y = 0.3 * i, h = 1.6;
      sources.push_back(glare_source({x, y, h}, 12.0, 0.01, std::sqrt(x * x + y * y + h * h)));
      if (std::abs(y) > 3.0 * x) continue;
      const double sigma = degrees(std::atan(std::hypot(y, h) / x)),
                   tau = degrees(std::atan(std::abs(y) / h));
      sum += 1200.0 * 1200.0 * 0.01 / (x * x + y * y + h * h) / std::pow(levin(sigma, tau), 2);
    }
  }
  CHECK(unified_glare_rating(sources, 55.0, kAhead).ugr ==
        Approx(8.0 * std::log10(0.25 / 55.0 * sum)).margin(1e-6));
}

TEST_CASE("Projected luminous areas are those of the bodies", "[glare][unit]") {
  const Vec3 down(0, 0, 1), along(1, 0, 0), across(0, 1, 0), slant = glm::normalize(Vec3(1, 2, 2));
  using S = OpeningShape;
  CHECK(projected_luminous_area_m2({S::kRectangle, 1.2, 0.3, 0}, slant) == Approx(0.36 * 2.0 / 3.0));
  CHECK(projected_luminous_area_m2({S::kBox, 1.2, 0.3, 0.1}, along) == Approx(0.03));
  CHECK(projected_luminous_area_m2({S::kBox, 1.2, 0.3, 0.1}, across) == Approx(0.12));
  CHECK(projected_luminous_area_m2({S::kEllipse, 0.4, 0.4, 0}, down) == Approx(kPi * 0.04));
  for (const Vec3& d : {down, along, slant})
    CHECK(projected_luminous_area_m2({S::kEllipsoid, 0.4, 0.4, 0.4}, d) == Approx(kPi * 0.04));
  CHECK(projected_luminous_area_m2({S::kVerticalCylinder, 0.4, 0.4, 0.5}, across) == Approx(0.2));
  CHECK(projected_luminous_area_m2({S::kHorizontalCylinder, 1.5, 0.04, 0.04}, across) == Approx(0.06));
  CHECK(projected_luminous_area_m2({S::kHorizontalCylinder, 1.5, 0.04, 0.04}, along) == Approx(kPi * 0.0004));
  CHECK(projected_luminous_area_m2({S::kPoint, 0, 0, 0}, down) == 0.0);
}

TEST_CASE("In a room of one luminance that is the background, whichever way one looks", "[glare][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  const auto database = uniform_database(zone, point_lamp({1.2, 0, 0.6}, 1000.0), 200.0);
  const GlareField field(database, {1.0});
  const EyePlace place = field.at({-1, 0.3, 0.1});
  for (const Vec3& forward : {Vec3(1, 0, 0), Vec3(0, -1, 0.3), Vec3(0.2, 0.1, -1)}) {
    const double background = background_cd_m2(place, LineOfSight::along(forward));
    CHECK(background == Approx(0.5 * 200.0 / kPi).epsilon(1e-3));
  }
}

TEST_CASE("A lamp glares by its intensity, not at all behind a wall or the eye", "[glare][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  const Vec3 lamp(1.2, 0, 0.6), eye(-1, 0, 0);
  const auto lights = point_lamp(lamp, 1000.0);
  const double intensity_cd = lights.luminaires[0].factor * lights.fittings[0].intensity.at({0, 0, 1});
  {
    const auto database = uniform_database(zone, lights, 200.0);
    const EyePlace place = GlareField(database, {1.0}).at(eye);
    const auto rating = glare_at(place, kAhead);
    const double p = position_index(lamp - eye, kAhead), r = glm::length(lamp - eye);
    const double term = 200.0 * intensity_cd * intensity_cd / (r * r * p * p);
    CHECK(rating.ugr == Approx(8.0 * std::log10(0.25 / (100.0 / kPi) * term)).margin(0.01));
    CHECK(std::isnan(glare_at(place, LineOfSight::along({-1, 0, 0})).ugr));
    CHECK(std::isnan(glare_at(GlareField(database, {0.0}).at(eye), kAhead).ugr));
  }
  add_box(zone, "screen", {0, -1, -0.9}, {0.1, 1, 0.9}, 0, 0.5, true);
  const auto database = uniform_database(zone, lights, 200.0);
  CHECK(GlareField(database, {1.0}).at(eye).sources.empty());
  const EyePlace within = GlareField(database, {1.0}).at({0.05, 0, 0});
  CHECK(within.enclosed);
  CHECK(std::isnan(glare_at(within, kAhead).ugr));
}

TEST_CASE("Observers look round from every point at the height asked for", "[glare][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.5, 0.5);
  zone.points = {{{-1, 0, -0.5}, {0, 0, 1}}, {{0.5, 0.5, -0.5}, {0, 0, 1}}};
  const PointSet set{"plane", 0, 2};
  const auto lights = point_lamp({1.2, 0, 0.6}, 1000.0);
  Zone bare = zone;
  bare.points.clear();
  const auto database = uniform_database(bare, lights, 200.0);
  const GlareField field(database, {1.0});
  const auto ratings = observer_ratings(zone, field, set, {1.2, 8}, Job{});
  REQUIRE(ratings.size() == 16);
  for (const auto& r : ratings) CHECK(r.eye.z == Approx(0.2));
  CHECK(ratings[2].direction_rad == Approx(kPi / 2));
  const auto* worst = worst_of(ratings);
  REQUIRE(worst);
  const auto alone =
      glare_at(field.at(worst->eye),
               LineOfSight::along({std::cos(worst->direction_rad), std::sin(worst->direction_rad), 0.0}));
  CHECK(worst->rating.ugr == alone.ugr);
  CHECK(worst_of({}) == nullptr);
}
