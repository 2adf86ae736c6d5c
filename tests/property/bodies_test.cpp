// Bodies of luminaires among the rays of a network, and what they do to the light.
#include <algorithm>
#include <random>

#include "catch.hpp"
#include "network/balance.hpp"
#include "network/with_bodies.hpp"
#include "scene/luminaire_body.hpp"
#include "transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

constexpr PatchGrid kRays{8, 16};

LuminousOpening shaped(OpeningShape shape, double length_m, double width_m, double height_m) {
  return {shape, length_m, width_m, height_m};
}

// A furnished room with a window's worth missing in one wall, points on the desk, under and beside bodies.
Zone open_room(double reflectance) {
  Zone zone = furnished_room(reflectance, 0.4);
  zone.surfaces[2].polygon = Polygon(Ring3{{-3, -2, -1.4}, {-3, -2, 1.4}, {1, -2, 1.4}, {1, -2, -1.4}});
  zone.points = {{{0, 0, -0.6}, {0, 0, 1}}, {{-2, 1, -1}, {1, 0, 0}}, {{1, -1, 1.2}, {0, 0, -1}}};
  return zone;
}

// Panels, boxes and round ones, hanging, tilted and touching; none lies on a surface.
Lights many_bodies(bool body = true) {
  const auto table = IntensityTable::lambertian(100.0);
  Lights lights;
  add_lamp(lights, "panel", {0.3, 0.2, 1.33}, table, {.opening = rectangle(0.6, 0.6), .body = body});
  add_lamp(lights, "box", {-1.5, -0.7, 0.6}, table,
           {.aim = {0.3, 0.1, -1}, .opening = shaped(OpeningShape::kBox, 1.2, 0.3, 0.15), .body = body});
  add_lamp(lights, "can", {1.6, -1.2, 0.9}, table,
           {.opening = shaped(OpeningShape::kVerticalCylinder, 0.2, 0.2, 0.3), .body = body});
  add_lamp(lights, "disc", {-2.95, 0.4, 0.2}, table,
           {.aim = {1, 0, 0}, .opening = shaped(OpeningShape::kEllipse, 0.4, 0.2, 0.0), .body = body});
  lights.luminaires[1].body_reflectance = 0.5;
  return lights;
}

void check_same(const Network& a, const Network& b) {
  REQUIRE(a.sinks.n_rays() == b.sinks.n_rays());
  REQUIRE(a.sinks.wide() == b.sinks.wide());
  std::size_t n_different = 0;
  for (std::size_t row = 0; row < a.sinks.n_rows(); ++row)
    for (std::size_t k = 0; k < a.sinks.n_patches(); ++k)
      n_different += a.sinks.at(row, k) != b.sinks.at(row, k);
  CHECK(n_different == 0);
  n_different = 0;
  for (std::size_t row = 0; row < a.point_sinks.n_rows(); ++row)
    for (std::size_t k = 0; k < a.point_sinks.n_patches(); ++k)
      n_different += a.point_sinks.at(row, k) != b.point_sinks.at(row, k);
  CHECK(n_different == 0);
  CHECK(a.n_escaped_rays == b.n_escaped_rays);
  CHECK(a.n_back_rays == b.n_back_rays);
  CHECK((a.point_back_fraction == b.point_back_fraction));
  CHECK((a.visible == b.visible));
  CHECK((a.row_scale == b.row_scale));
  CHECK((a.column_scale == b.column_scale));
  CHECK((a.extra.cell == b.extra.cell));
  CHECK((a.extra.weight == b.extra.weight));
}

// Emitted light that ends in the room's and the bodies' cells, over what was emitted.
double accounted(const Solution& solution, std::size_t source = 0) {
  const auto& e = solution.sources[source].energy[0];
  return (e.absorbed_W + e.escaped_W + e.lost_W + e.dropped_W) / e.emitted_W;
}

double mean_floor_lx(const Zone& zone, const Solution& solution) {
  const Cells cells(zone);
  const auto lx = cell_lx(solution);
  double sum = 0.0, area_m2 = 0.0;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    sum += cells.area_m2(i) * lx[i];
    area_m2 += cells.area_m2(i);
  }
  return sum / area_m2;
}

}  // namespace

TEST_CASE("Rays meet bodies as if the zone had been traced with them", "[bodies][network][property]") {
  const bool open = GENERATE(false, true);
  const auto sampling = GENERATE(Sampling::stratified, Sampling::centre);
  const bool family = sampling == Sampling::centre;
  const Zone zone = open ? open_room(0.5) : furnished_room(0.5, 0.4);
  const Cells cells(zone);
  NetworkOptions options;
  options.patches = kRays;
  options.point_patches = {16, 32};
  options.sampling = sampling;
  options.family = family;
  options.seed = 7;
  const Network before = build_network(zone, cells, options, Job{});
  const auto room = add_bodies(zone, cells, before, many_bodies(), Job{});
  REQUIRE(room);
  REQUIRE(room->n_bodies == 4);
  REQUIRE(room->n_zone_cells == cells.size());
  REQUIRE(room->cells.size() > cells.size());
  check_same(room->network, build_network(room->zone, Cells(room->zone), options, Job{}));
  std::size_t on_bodies = 0;
  for (std::size_t row = 0; row < cells.size(); ++row)
    for (std::size_t k = 0; k < kRays.n_patches(); ++k) {
      const auto sink = room->network.sinks.at(row, k);
      on_bodies += sink >= cells.size() && sink < room->cells.size();
    }
  CHECK(on_bodies > 1000);
}

TEST_CASE("Rays meet the ends of long bodies", "[bodies][network][property]") {
  const Zone zone = furnished_room(0.5, 0.5);
  const Cells cells(zone);
  Lights lights;
  add_lamp(lights, "tube", {0.2, 0.1, 0.9}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(2.4, 0.06), .body = true});
  NetworkOptions options;
  options.patches = {24, 48};
  options.point_patches = {16, 32};
  const auto room = add_bodies(zone, cells, build_network(zone, cells, options, Job{}), lights, Job{});
  REQUIRE(room);
  check_same(room->network, build_network(room->zone, Cells(room->zone), options, Job{}));
}

TEST_CASE("Sinks widen where bodies make the cells too many for two bytes", "[bodies][network][property]") {
  Zone zone = box_zone({8, 8, 8}, 0.5, 1.0);
  zone.surfaces[0].grid = {255, 255};
  const Cells cells(zone);
  NetworkOptions options;
  options.patches = {1, 2};
  options.point_patches = {1, 2};
  const Network before = build_network(zone, cells, options, Job{});
  REQUIRE_FALSE(before.sinks.wide());
  Lights lights;
  add_lamp(lights, "large", {0, 0, 1}, IntensityTable::lambertian(1.0),
           {.opening = rectangle(4, 4), .body = true});
  const auto room = add_bodies(zone, cells, before, lights, Job{});
  REQUIRE(room->network.sinks.wide());
  check_same(room->network, build_network(room->zone, Cells(room->zone), options, Job{}));
}

TEST_CASE("Without bodies there is nothing to add", "[bodies][network][property]") {
  const Zone zone = furnished_room(0.5, 0.8);
  const Network network = network_of(zone, {2, 4});
  CHECK_FALSE(add_bodies(zone, Cells(zone), network, many_bodies(false), Job{}));
  Lights lights;
  add_lamp(lights, "point", {0, 0, 0}, IntensityTable::isotropic(1.0), {.body = true});
  CHECK_FALSE(add_bodies(zone, Cells(zone), network, lights, Job{}));
}

TEST_CASE("A network with bodies that does not fit is refused", "[bodies][network][property]") {
  const Zone zone = furnished_room(0.5, 0.8);
  Job job;
  job.memory_limit_bytes = 1000;
  CHECK_THROWS_AS(add_bodies(zone, Cells(zone), network_of(zone, {2, 4}), many_bodies(), job), LimitError);
}

TEST_CASE("All light ends somewhere with bodies of any reflectance", "[bodies][simulate][property]") {
  const double rho = GENERATE(0.0, 0.5, 0.9);
  const Zone zone = furnished_room(rho, 0.3);
  Lights lights = many_bodies();
  for (auto& luminaire : lights.luminaires) luminaire.body_reflectance = rho;
  // A source that bodies stand round, and that throws light at its own body.
  add_lamp(lights, "all round", {0, 0, 0}, IntensityTable::isotropic(50.0),
           {.opening = rectangle(0.3, 0.3), .body = true});
  const auto solution = solve(zone, lights, network_of(zone, {16, 32}));
  for (std::size_t s = 0; s < solution.sources.size(); ++s) {
    INFO(solution.sources[s].name);
    CHECK(accounted(solution, s) == Approx(1.0).epsilon(3e-3));
  }
}

TEST_CASE("A closed room of one reflectance and one emission is uniform, bodies and all",
          "[bodies][network][property]") {
  const double rho = 0.7;
  const Zone zone = furnished_room(rho, 0.4);
  const Cells cells(zone);
  Lights lights = many_bodies();
  for (const double below_m : {2e-4, 0.01, 0.03})
    add_lamp(lights, "lying", {70.0 * below_m, 0.9, 1.4 - below_m}, IntensityTable::lambertian(1.0),
             {.opening = rectangle(0.5, 0.7), .body = true});
  for (auto& luminaire : lights.luminaires) luminaire.body_reflectance = rho;
  const auto room = add_bodies(zone, cells, network_of(zone, kRays), lights, Job{});
  // Every cell receives 1 - rho directly: then every cell that sees only cells has E = 1.
  const std::size_t n = room->cells.size();
  const Reflectances reflectances{1, std::vector<double>(room->zone.surfaces.size(), rho), {0}};
  GatherOptions options;
  options.tolerance = 1e-10;
  options.max_iterations = 400;
  const auto direct = Columns<double>::from_rows(std::vector<double>(n, 1.0 - rho), 1);
  const Columns<double> points(room->zone.points.size(), 1);
  const auto gathered = gather(room->network, room->cells, direct, points, reflectances, options, Job{});
  REQUIRE_FALSE(room->network.is_open());
  double worst = 0.0;
  for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(gathered.cell.value(i, 0) - 1.0));
  CHECK(worst < 1e-8);
}

TEST_CASE("A body equals a two-sided surface of the zone at its place", "[bodies][simulate][property]") {
  const double rho = GENERATE(0.0, 0.8);
  Zone zone = furnished_room(0.6, 0.3);
  for (int i = 0; i < 12; ++i)
    zone.points.push_back({{-2.2 + 0.4 * i, 0.3 * (i % 3) - 0.2, -0.6}, {0, 0, 1}});
  Lights lights;
  for (const double x : {-1.5, 1.5})
    add_lamp(lights, "panel" + std::to_string(x), {x, 0.2, 1.1}, IntensityTable::lambertian(200.0),
             {.opening = rectangle(0.6, 0.9), .body = true});
  for (auto& luminaire : lights.luminaires) luminaire.body_reflectance = rho;
  Zone furnished = zone;
  const int finish = add_grey(furnished, rho);
  for (const auto& luminaire : lights.luminaires) {
    const Vec3 c = luminaire.at + Vec3(0, 0, 1e-4);
    add_surface(furnished, "panel",
                {c + Vec3(-0.3, -0.45, 0), c + Vec3(-0.3, 0.45, 0), c + Vec3(0.3, 0.45, 0),
                 c + Vec3(0.3, -0.45, 0)},
                finish, 0.3);
    auto& front = furnished.surfaces.back();
    REQUIRE(front.polygon.normal().z == Approx(-1.0));
    front.bounding = false;
    front.twin = static_cast<int>(furnished.surfaces.size());
    Surface back = front;
    back.polygon = front.polygon.reversed();
    back.twin = front.twin - 1;
    furnished.surfaces.push_back(back);
  }
  Lights bare = lights;
  for (auto& luminaire : bare.luminaires) luminaire.body = false;
  const SimulationOptions options{.combine = Combine::all, .gather = {.tolerance = 1e-6}};
  const auto with_body = solve(zone, lights, network_of(zone, {16, 32}), options);
  const auto with_panel = solve(furnished, bare, network_of(furnished, {16, 32}), options);
  const auto without = solve(zone, bare, network_of(zone, {16, 32}), options);
  const auto a = point_lx(with_body), b = point_lx(with_panel), c = point_lx(without);
  double mean = 0.0, mean_without = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i] == Approx(b[i]).epsilon(5e-3));
    mean += a[i] / b[i] / static_cast<double>(a.size());
    mean_without += c[i] / b[i] / static_cast<double>(a.size());
  }
  CHECK(mean == Approx(1.0).epsilon(1e-3));
  // What bodies change is many times what sampling may.
  if (rho == 0.0) CHECK(mean_without > 1.01);
}

TEST_CASE("Black bodies take light and white ones give it back", "[bodies][simulate][property]") {
  // Recessed panels hide what is behind them: a white one in front of a grey ceiling brightens the room.
  const Zone zone = box_zone({4, 3, 2.5}, 0.5, 0.25);
  const Network network = network_of(zone, {8, 16});
  const auto floor_lx = [&](bool body, double reflectance) {
    Lights lights;
    for (const double x : {-1.0, 1.0}) {
      add_lamp(lights, "panel" + std::to_string(x), {x, 0, 1.25 - 2e-4}, IntensityTable::lambertian(300.0),
               {.opening = rectangle(1.0, 1.0), .body = body});
      lights.luminaires.back().body_reflectance = reflectance;
    }
    return mean_floor_lx(zone, solve(zone, lights, network, {.combine = Combine::all}));
  };
  const double none = floor_lx(false, 0.0), black = floor_lx(true, 0.0), same = floor_lx(true, 0.5),
               white = floor_lx(true, 0.8);
  CHECK(black < 0.98 * same);
  CHECK(white > 1.01 * same);
  // A panel of the ceiling's own reflectance is not seen, whichever part of a cell it covers.
  CHECK(same == Approx(none).epsilon(2e-3));
}

TEST_CASE("The order of luminaires with bodies does not matter", "[bodies][network][property]") {
  const Zone zone = furnished_room(0.5, 0.4);
  const Cells cells(zone);
  const Network network = network_of(zone, kRays);
  Lights lights = many_bodies();
  const auto room = add_bodies(zone, cells, network, lights, Job{});
  std::reverse(lights.luminaires.begin(), lights.luminaires.end());
  const auto turned = add_bodies(zone, cells, network, lights, Job{});
  check_same(room->network, turned->network);
  for (std::size_t s = 0; s < room->zone.surfaces.size(); ++s) {
    REQUIRE(room->zone.surfaces[s].name == turned->zone.surfaces[s].name);
    const auto reflectance = [&](const Zone& of) {
      return of.finishes[static_cast<std::size_t>(of.surfaces[s].finish)].diffuse.at(550.0);
    };
    CHECK(reflectance(room->zone) == reflectance(turned->zone));
  }
}

TEST_CASE("Two bodies face each other with nothing between", "[bodies][network][property]") {
  // Parallel squares of side 1 at distance 1: F = 0.19982 (Howell C-11).
  const Zone zone = box_zone({3, 3, 3}, 0.0, 0.25);
  const Cells cells(zone);
  Lights lights;
  add_lamp(lights, "down", {0, 0, 0.5}, IntensityTable::lambertian(1.0),
           {.opening = rectangle(1, 1), .body = true});
  add_lamp(lights, "up", {0, 0, -0.5}, IntensityTable::lambertian(1.0),
           {.aim = {0, 0, 1}, .opening = rectangle(1, 1), .body = true});
  const auto room = add_bodies(zone, cells, network_of(zone, {32, 64}), lights, Job{});
  // From one's front to the other's: fronts are 2e-4 farther apart than the openings.
  std::vector<std::size_t> fronts;
  for (std::size_t s = 6; s < room->zone.surfaces.size(); ++s) {
    if (room->zone.surfaces[s].name.ends_with("front")) fronts.push_back(s);
  }
  REQUIRE(fronts.size() == 2);
  for (int way = 0; way < 2; ++way) {
    const auto from = fronts[static_cast<std::size_t>(way)], to = fronts[static_cast<std::size_t>(1 - way)];
    std::vector<double> ones(room->cells.size(), 0.0);
    std::fill(ones.begin() + static_cast<std::ptrdiff_t>(room->cells.first(to)),
              ones.begin() + static_cast<std::ptrdiff_t>(room->cells.first(to + 1)), 1.0);
    const auto seen = apply_rows(room->network, ones);
    double factor = 0.0;
    for (std::size_t i = room->cells.first(from); i < room->cells.first(from + 1); ++i)
      factor += room->cells.area_m2(i) * seen[i];
    CHECK(factor == Approx(0.19982).epsilon(5e-3));
  }
}
