// The whole solution: bands, combinations, limits of reflectance, refusals, energy.
#include "transport/simulate.hpp"

#include <algorithm>

#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

const PatchGrid kFew{6, 12};

Zone small_room(double reflectance) {
  Zone zone = furnished_room(reflectance, 0.8);
  zone.points.push_back({{0, 0, -0.4}, {0, 0, 1}});
  zone.points.push_back({{-1.5, 0.7, 0.2}, {1, 0, 0}});
  return zone;
}

Lights three_lamps() {
  Lights lights;
  add_lamp(lights, "a", {-2, 0, 1.2}, IntensityTable::isotropic(1.0), {.factor = 200.0, .group = "row"});
  add_lamp(lights, "b", {1, 1, 1.2}, IntensityTable::lambertian(300.0),
           {.opening = rectangle(0.6, 0.3), .group = "row"});
  add_lamp(lights, "c", {2, -1, 0.5}, IntensityTable::lambertian(80.0), {.aim = {1, 0, -1}, .factor = 2.0});
  return lights;
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double mean = 0.0, worst = 0.0;
  REQUIRE(a.size() == b.size());
  for (const double x : b) mean += x / static_cast<double>(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return mean > 0.0 ? worst / mean : worst;
}

std::string refusal(const Zone& zone) {
  try {
    const Network network = network_of(zone, {1, 1});
    solve(zone, point_lamp({0, 0, 0}, 1.0), network);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Sources apart, in groups and together give the same light", "[simulate][unit]") {
  const Zone zone = small_room(0.6);
  const Network network = network_of(zone, kFew);
  const Lights lights = three_lamps();
  SimulationOptions options;
  options.gather.tolerance = 1e-10;
  const auto sum_of = [&](Combine combine, std::size_t n_sources) {
    options.combine = combine;
    const Solution solution = solve(zone, lights, network, options);
    REQUIRE(solution.sources.size() == n_sources);
    std::vector<double> cells(solution.n_cells), points(solution.n_points);
    double flux_lm = 0.0;
    for (std::size_t s = 0; s < n_sources; ++s) {
      const auto c = cell_lx(solution, s), p = point_lx(solution, s);
      for (std::size_t i = 0; i < c.size(); ++i) cells[i] += c[i];
      for (std::size_t i = 0; i < p.size(); ++i) points[i] += p[i];
      flux_lm += solution.sources[s].flux_lm;
    }
    CHECK(flux_lm == Approx(4 * kPi * 200 + kPi * 300 + kPi * 160).epsilon(1e-12));
    cells.insert(cells.end(), points.begin(), points.end());
    return cells;
  };
  const auto each = sum_of(Combine::each, 3), group = sum_of(Combine::group, 2),
             all = sum_of(Combine::all, 1);
  // Irradiances are stored in single precision, 6e-8 each.
  CHECK(worst_difference(group, each) < 1e-6);
  CHECK(worst_difference(all, each) < 1e-6);
}

TEST_CASE("Sources are named after luminaires, groups or all", "[simulate][unit]") {
  const Zone zone = small_room(0.3);
  const Network network = network_of(zone, {2, 4});
  SimulationOptions options;
  const auto names = [&](Combine combine) {
    options.combine = combine;
    std::vector<std::string> result;
    for (const auto& source : solve(zone, three_lamps(), network, options).sources)
      result.push_back(source.name + "/" + source.group + "/" + std::to_string(source.luminaires.size()));
    return result;
  };
  CHECK(names(Combine::each) == std::vector<std::string>{"a/row/1", "b/row/1", "c/c/1"});
  CHECK(names(Combine::group) == std::vector<std::string>{"row/row/2", "c/c/1"});
  CHECK(names(Combine::all) == std::vector<std::string>{"all/all/3"});
}

TEST_CASE("Luminaires of different spectrum are never made one source", "[simulate][unit]") {
  const Zone zone = small_room(0.3);
  const Network network = network_of(zone, {2, 4});
  Lights lights = three_lamps();
  lights.fittings[1].spectrum = SpectralCurve({{380, 0.1}, {780, 1.0}});
  SimulationOptions options;
  options.combine = Combine::all;
  const auto solution = solve(zone, lights, network, options);
  REQUIRE(solution.sources.size() == 2);
  CHECK(solution.sources[0].luminaires == std::vector<std::string>{"a", "c"});
  CHECK(solution.sources[1].luminaires == std::vector<std::string>{"b"});
}

TEST_CASE("Intensities scale the answer exactly", "[simulate][unit]") {
  const Zone zone = small_room(0.6);
  const Network network = network_of(zone, kFew);
  const auto reference = solve(zone, three_lamps(), network);
  for (const double factor : {0x1p-40, 0x1p40, 1e-12, 1e-3, 7.0, 1e12}) {
    Lights lights = three_lamps();
    for (auto& lamp : lights.luminaires) lamp.factor *= factor;
    const auto scaled = solve(zone, lights, network);
    const bool power_of_two = std::exp2(std::round(std::log2(factor))) == factor;
    std::size_t n_wrong = 0;
    for (const auto member : {&Solution::cell_direct, &Solution::cell_total, &Solution::point_total}) {
      const auto &a = scaled.*member, &b = reference.*member;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double expected = static_cast<double>(b[i]) * factor, got = static_cast<double>(a[i]);
        n_wrong += power_of_two ? got != expected : std::abs(got - expected) > 1e-6 * expected;
      }
    }
    CAPTURE(factor);
    CHECK(n_wrong == 0);
    // Direct light is held in single precision.
    CHECK(scaled.sources[0].energy[0].imbalance ==
          Approx(reference.sources[0].energy[0].imbalance).margin(1e-7));
  }
}

TEST_CASE("A source of zero lumens gives zeros and no NaN", "[simulate][unit]") {
  const Zone zone = small_room(0.6);
  const Network network = network_of(zone, kFew);
  Lights lights = three_lamps();
  lights.luminaires[0].factor = 0.0;
  add_lamp(lights, "none", {0, 0, 0}, IntensityTable::isotropic(0.0));
  const bool all_off = GENERATE(false, true);
  if (all_off)
    for (auto& lamp : lights.luminaires) lamp.factor = 0.0;
  const auto solution = solve(zone, lights, network);
  for (const std::size_t s : {std::size_t{0}, std::size_t{3}}) {
    for (const double lx : cell_lx(solution, s)) CHECK(lx == 0.0);
    for (const double lx : point_lx(solution, s)) CHECK(lx == 0.0);
    const auto& source = solution.sources[s];
    CHECK(source.flux_lm == 0.0);
    CHECK(source.energy[0].imbalance == 0.0);
    CHECK(source.error_bound == 0.0);
  }
  for (const float w : solution.cell_total) CHECK(std::isfinite(w));
}

TEST_CASE("In a black room total is direct", "[simulate][unit]") {
  const Zone zone = small_room(0.0);
  const auto solution = solve(zone, three_lamps(), network_of(zone, kFew));
  CHECK(solution.cell_total == solution.cell_direct);
  CHECK(solution.point_total == solution.point_direct);
}

TEST_CASE("A reflectance of one or more is refused by the finish's name", "[simulate][unit]") {
  for (const double rho : {1.0, 1.2}) {
    Zone zone = box_zone({2, 2, 2}, 0.5, 1.0);
    zone.surfaces[2].finish = add_grey(zone, rho);
    zone.finishes.back().name = "snow";
    const auto message = refusal(zone);
    CHECK(message.find("'snow'") != std::string::npos);
    CHECK(message.find("less than 1") != std::string::npos);
  }
  CHECK(refusal(box_zone({2, 2, 2}, 0.9999, 1.0)).empty());
}

TEST_CASE("A grey room gives the same illuminance with any number of bands", "[simulate][unit]") {
  const Zone zone = small_room(0.6);
  const Network network = network_of(zone, kFew);
  Lights lights = three_lamps();
  lights.fittings[0].spectrum = SpectralCurve({{380, 0.2}, {500, 1.0}, {600, 0.3}, {780, 2.0}});
  const auto one = solve(zone, lights, network);
  CHECK(one.classes.size() == 1);
  for (const int n : {3, 9}) {
    SimulationOptions options;
    options.bands = Bands::uniform(n);
    const auto many = solve(zone, lights, network, options);
    CHECK(many.classes.size() == 1);
    for (std::size_t s = 0; s < 3; ++s) {
      // Stored in single precision: one rounding, 6e-8, in each.
      const auto many_lx = cell_lx(many, s), one_lx = cell_lx(one, s);
      for (std::size_t i = 0; i < one_lx.size(); ++i) REQUIRE(many_lx[i] == Approx(one_lx[i]).epsilon(2e-7));
      CHECK(worst_difference(point_lx(many, s), point_lx(one, s)) < 1e-6);
    }
  }
}

TEST_CASE("Each band of a coloured room is the grey room of that band's reflectance", "[simulate][unit]") {
  Zone zone = small_room(0.6);
  // Piecewise linear: means over 380-520, 520-640, 640-780 nm follow by hand.
  zone.finishes[0].diffuse = SpectralCurve({{380, 0.2}, {520, 0.2}, {640, 0.8}, {780, 0.8}});
  const Network network = network_of(zone, kFew);
  SimulationOptions options;
  options.bands.edges_nm = {380, 520, 640, 780};
  const Lights lights = three_lamps();
  const auto coloured = solve(zone, lights, network, options);
  CHECK(coloured.classes.size() == 3);
  const std::vector<double> reflectance = {0.2, 0.5, 0.8};
  for (std::size_t b = 0; b < 3; ++b) {
    zone.finishes[0].diffuse = SpectralCurve(reflectance[b]);
    const auto grey = solve(zone, lights, network, options);
    for (std::size_t s = 0; s < 3; ++s) {
      double worst = 0.0, largest = 0.0;
      for (std::size_t i = 0; i < grey.n_cells; ++i) {
        const auto expected = static_cast<double>(grey.cell_total[grey.cell_row(s, 0) + i]);
        const auto got = static_cast<double>(coloured.cell_total[coloured.cell_row(s, b) + i]);
        worst = std::max(worst, std::abs(got - expected));
        largest = std::max(largest, expected);
      }
      // Columns solved together stop together, which is within the tolerance of gathering.
      CHECK(worst < 1e-3 * largest);
    }
  }
}

TEST_CASE("Bands of one reflectance share one solution", "[simulate][unit]") {
  Zone zone = small_room(0.6);
  zone.finishes[0].diffuse = SpectralCurve({{380, 0.3}, {580, 0.3}, {580.001, 0.7}, {780, 0.7}});
  SimulationOptions options;
  options.bands = Bands::uniform(8);  // of 50 nm: 580 is an edge
  const auto solution = solve(zone, three_lamps(), network_of(zone, {2, 4}), options);
  // Means of equal plateaus may differ in the last digit; no more than a few classes, not one a band.
  CHECK(solution.classes.size() <= 4);
}

TEST_CASE("Power in watts is the flux divided by the efficacy and shared over bands", "[simulate][unit]") {
  const Zone zone = small_room(0.4);
  SimulationOptions options;
  options.bands = Bands::uniform(4);
  const auto solution = solve(zone, point_lamp({0, 0, 1}, 100.0), network_of(zone, kFew), options);
  // Equal-energy light: 683 x 106.857 / 400 lm/W (CIE, integral of V), a quarter in each of four bands.
  const double watts = 400 * kPi / (683.0 * 106.857 / 400.0);
  for (const auto& energy : solution.sources[0].energy) {
    CHECK(energy.emitted_W == Approx(watts / 4).epsilon(1e-4));
    CHECK(std::abs(energy.imbalance) < 2e-3);
    CHECK(energy.escaped_W == 0.0);
    CHECK(energy.absorbed_W + energy.dropped_W + energy.lost_W ==
          Approx(energy.emitted_W * (1 - energy.imbalance)).epsilon(1e-12));
  }
}

TEST_CASE("An open room's light is accounted for", "[simulate][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.6, 0.25);
  zone.surfaces.erase(zone.surfaces.begin() + 1);
  const auto solution = solve(zone, point_lamp({0.3, 0.2, -0.1}, 100.0), network_of(zone, {8, 16}));
  const auto& energy = solution.sources[0].energy[0];
  const double through_opening = solid_angle_sr({-2.3, -1.7}, {1.7, 1.3}, 1.1) / (4 * kPi);
  CHECK(energy.escaped_W > through_opening * energy.emitted_W * 0.99);
  CHECK(energy.escaped_W < energy.emitted_W);
  CHECK(std::abs(energy.imbalance) < 2e-3);
}

TEST_CASE("Light that a black body takes is accounted for as absorbed", "[simulate][bodies][unit]") {
  const Zone zone = box_zone({4, 3, 2}, 0.0, 0.25);
  Lights lights;
  add_lamp(lights, "panel", {0, 0, 0.5}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(1.0, 1.0), .body = true});
  add_lamp(lights, "up", {0, 0, -0.5}, IntensityTable::lambertian(100.0), {.aim = {0, 0, 1}});
  const auto solution = solve(zone, lights, network_of(zone, {8, 16}));
  REQUIRE(solution.n_cells == Cells(zone).size());
  const auto& up = solution.sources[1].energy[0];
  // From 1 m below, under the middle of the 1 m square: 4 corners of the configuration factor, X = Y = 1/2.
  const double x = 0.5, p = std::sqrt(1 + x * x), share = 4 * 2 * (x / p * std::atan(x / p)) / (2 * kPi);
  double in_room_lm = 0.0;
  const Cells cells(zone);
  for (std::size_t i = 0; i < cells.size(); ++i)
    in_room_lm += cells.area_m2(i) * static_cast<double>(solution.cell_total[solution.cell_row(1, 0) + i]);
  CHECK(1.0 - in_room_lm / solution.sources[1].flux_lm == Approx(share).epsilon(0.01));
  CHECK(up.absorbed_W == Approx(up.emitted_W).epsilon(2e-3));
  CHECK(up.lost_W == 0.0);
}

TEST_CASE("A lamp in the wrong place is warned of by name", "[simulate][unit]") {
  const Zone zone = small_room(0.5);
  Lights lights = point_lamp({2.5, 1.0, -0.5}, 100.0);  // in the cabinet
  lights.luminaires[0].name = "hidden";
  const Network network = network_of(zone, {2, 4});
  Warnings warnings;
  simulate(zone, Cells(zone), network, lights, {}, Job{}, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].what.find("'hidden'") != std::string::npos);
}

TEST_CASE("A solution that does not fit is refused beforehand", "[simulate][unit]") {
  const Zone zone = small_room(0.5);
  const Network network = network_of(zone, {2, 4});
  Job job;
  job.memory_limit_bytes = 1000;
  Warnings warnings;
  CHECK_THROWS_AS(simulate(zone, Cells(zone), network, three_lamps(), {}, job, warnings), LimitError);
}

TEST_CASE("A source has the flux of all its luminaires", "[simulate][unit]") {
  const Lights lights = three_lamps();
  const auto combined = combine(lights, Bands::uniform(1), Combine::group);
  REQUIRE(combined.sources.size() == 2);
  CHECK(combined.of_luminaire == std::vector<std::size_t>{0, 0, 1});
  CHECK(combined.sources[0].flux_lm == Approx(200.0 * 4.0 * kPi + 300.0 * kPi).epsilon(1e-9));
  CHECK(combined.sources[1].flux_lm == Approx(2.0 * 80.0 * kPi).epsilon(1e-9));
}

TEST_CASE("The luminances of a source's classes add up to its flux, whatever its spectrum", "[simulate][unit]") {
  Source source;
  source.weights = band_weights(SpectralCurve({{380, 0.1}, {500, 0.2}, {780, 1.0}}), Bands::uniform(4));
  ReflectanceClasses classes;
  classes.of_band = {0, 1, 2, 1};
  classes.of_finish.resize(3);
  double luminance = 0.0;
  for (const Vec3& xyz : source.xyz_by_class(classes)) luminance += xyz.y;
  CHECK(luminance == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("Light on the back of a surface is lost, and said to be", "[simulate][unit]") {
  Zone zone = box_zone({4, 3, 2}, 0.0, 0.25);
  // It faces the floor: the lamp above sees its back.
  add_surface(zone, "screen", {{-0.5, -0.4, -0.5}, {-0.5, 0.4, -0.5}, {0.5, 0.4, -0.5}, {0.5, -0.4, -0.5}}, 0, 0.5);
  zone.surfaces.back().bounding = false;
  REQUIRE(zone.surfaces.back().polygon.normal().z < 0.0);
  const auto solution = solve(zone, point_lamp({0, 0, 0.2}, 100.0), network_of(zone, kFew));
  const auto& energy = solution.sources[0].energy[0];
  const double on_back = solid_angle_sr({-0.5, -0.4}, {0.5, 0.4}, 0.7) / (4.0 * kPi);
  CHECK(energy.lost_W == Approx(on_back * energy.emitted_W).epsilon(0.01));
  CHECK(std::abs(energy.imbalance) < 2e-3);
}
