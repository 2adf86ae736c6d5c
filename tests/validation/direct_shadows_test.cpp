// Direct light where benches did not look: thin shadows, company, horizons, touching openings, narrow beams. The
// other method of each case is a count of rays between random points, or a sum written here.
#include <cmath>

#include "catch.hpp"
#include "property/transport_support.hpp"
#include "light/direct_light.hpp"
#include "light/opening_region.hpp"

using namespace dim;
using namespace dim::test;

namespace {

Zone slatted_room(double share) {
  Zone zone = box_zone({4, 4, 3}, 0.0, 0.5);
  const double half_m = 0.2 * share;  // ten bars, 0.4 m apart
  for (int i = 0; i < 10; ++i) {
    const double x = -1.8 + 0.4 * i;
    const Ring3 bar = {{x - half_m, -1.99, 0}, {x + half_m, -1.99, 0}, {x + half_m, 1.99, 0}, {x - half_m, 1.99, 0}};
    add_surface(zone, "bar", bar, 0, 0.5);
    zone.surfaces.push_back(zone.surfaces.back());
    zone.surfaces.back().polygon = zone.surfaces.back().polygon.reversed();
    zone.surfaces.back().twin = static_cast<int>(zone.surfaces.size()) - 2;
    zone.surfaces[zone.surfaces.size() - 2].twin = static_cast<int>(zone.surfaces.size()) - 1;
    for (std::size_t s = zone.surfaces.size() - 2; s < zone.surfaces.size(); ++s) zone.surfaces[s].bounding = false;
  }
  return zone;
}

double floor_mean_lx(const Zone& zone, const DirectLight& light, std::size_t n_sources, std::size_t source) {
  const Cells cells(zone);
  double lm = 0.0, area_m2 = 0.0;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    lm += cells.area_m2(i) * light.cell_lx[i * n_sources + source];
    area_m2 += cells.area_m2(i);
  }
  return lm / area_m2;
}

// Mean over pairs of points of cell and opening, and what of it is not blocked.
std::pair<double, double> counted_lx(const Receiver& receiver, const Luminaire& lamp, const Fitting& fitting,
                                     const RayCaster& caster, int n) {
  const auto opening = opening_region(lamp);
  const LowDiscrepancy4 points(mix(receiver.stream + 1));
  double free = 0.0, visible = 0.0;
  for (int i = 0; i < n; ++i) {
    const auto x = points(static_cast<std::uint64_t>(i));
    const Vec3 p = receiver.ring.sample(x[0], x[1]), q = opening.ring.sample(x[2], x[3]), d = p - q;
    const double r2 = glm::dot(d, d), height = -glm::dot(d, receiver.frame->n);
    if (!(height > 0.0)) continue;
    const double lx = fitting.intensity.at(lamp.to_local(d)) * height / (r2 * std::sqrt(r2)) / n;
    free += lx;
    if (!caster.blocked(p, q, receiver.skip)) visible += lx;
  }
  return {free, visible};
}

}  // namespace

TEST_CASE("Slats take from a floor what they cover, whatever else shines", "[direct][validation]") {
  const double share = GENERATE(0.02, 0.05, 0.10);
  const Zone zone = slatted_room(share);
  Lights lights;
  add_lamp(lights, "A", {0, 0, 1.4}, IntensityTable::lambertian(3000.0 / kPi), {.opening = rectangle(1, 1)});
  const auto alone = test::direct(zone, lights);

  const Obstructions obstructions(zone, lights);
  const Cells cells(zone);
  double counted_lm = 0.0;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i)
    counted_lm += cells.area_m2(i) * counted_lx(cell_receiver(zone, cells, i), lights.luminaires[0],
                                                lights.fittings[0], obstructions.caster(), 1 << 14)
                                         .second;
  CAPTURE(share);
  CHECK(floor_mean_lx(zone, alone, 1, 0) == Approx(counted_lm / 16.0).epsilon(1.5e-3));

  for (int i = 0; i < 30; ++i)
    add_lamp(lights, "X" + std::to_string(i), {0.001 * i, 0, 1.4}, IntensityTable::lambertian(1e-7),
             {.opening = rectangle(1, 1)});
  std::rotate(lights.luminaires.begin(), lights.luminaires.begin() + 7, lights.luminaires.end());
  const auto company = test::direct(zone, lights);
  for (std::size_t i = 0; i < cells.size(); ++i) REQUIRE(company.cell_lx[i * 31 + 24] == alone.cell_lx[i]);
}

TEST_CASE("Behind a wall the visible share is found without bias", "[direct][validation]") {
  const bool point = GENERATE(false, true);
  Zone zone = box_zone({4, 4, 3}, 0.0, 0.25);
  const Vec3 along(std::cos(0.4), std::sin(0.4), 0), foot(0.03, -0.52, -1.5), up(0, 0, 1.5);
  add_surface(zone, "wall", {foot - along * 0.8, foot + along * 0.8, foot + along * 0.8 + up, foot - along * 0.8 + up},
              0, 0.25);
  Lights lights;
  add_lamp(lights, "lamp", {0.1, 0.3, 1.3}, IntensityTable::isotropic(50.0),
           {.opening = point ? LuminousOpening{} : rectangle(0.6, 0.6)});
  const Cells cells(zone);
  const Obstructions obstructions(zone, lights);
  const auto sources = own_sources(zone, lights);
  const PairIntegrator integrator(zone, obstructions.caster(), obstructions.shadows(), sources[0], {});
  double sum = 0.0, squares = 0.0, stated = 0.0;
  int n = 0;
  for (std::size_t i = cells.first(0); i < cells.first(1); ++i) {
    const Receiver receiver = cell_receiver(zone, cells, i);
    const auto found = integrator.mean(receiver);
    const auto [free, visible] = counted_lx(receiver, lights.luminaires[0], lights.fittings[0],
                                            obstructions.caster(), 1 << 13);
    if (visible == 0.0 || visible == free) {
      CHECK(found.lx == Approx(visible).epsilon(2e-3).margin(2e-3 * free));
      continue;
    }
    const double off = (found.lx - visible) / free;
    sum += off;
    squares += off * off;
    stated += found.variance_lx2 / (free * free);
    ++n;
  }
  REQUIRE(n > 25);
  // The count's own error is some 0.4 % of the free value, that of a lattice of 128 lines 0.4 %.
  CHECK(std::abs(sum / n) < 1.5e-3);
  CHECK(std::sqrt(squares / n) < 8e-3);
  CHECK(std::sqrt(stated / n) < 1.5e-2);
  CHECK(stated > 0.0);
}

TEST_CASE("An opening on the horizon counts as far as it reaches over it", "[direct][validation]") {
  Zone zone = box_zone({40, 40, 40}, 0.0, 40.0);
  add_box(zone, "speck", {-19, -19, -19}, {-18.9, -18.9, -18.9}, 0, 1.0, true);
  for (int i = 0; i < 8; ++i) zone.points.push_back({{10.0 + 0.5 * i, 0, 0}, {0, 0, 1}});
  for (const double tilt : {88.0, 90.0, 92.0, 95.0, 98.0})
    zone.points.push_back({{10, 0, 0}, glm::normalize(Vec3(std::cos(radians(tilt)) * -1.0, 0, std::sin(radians(tilt))))});
  Lights lights;
  add_lamp(lights, "A", {0, 0, 0}, IntensityTable::lambertian(100.0), {.aim = {1, 0, 0}, .opening = rectangle(2, 2)});
  const auto light = test::direct(zone, lights);
  for (std::size_t p = 0; p < zone.points.size(); ++p) {
    constexpr int kN = 800;
    double lx = 0.0;
    for (int i = 0; i < kN; ++i) {
      for (int j = 0; j < kN; ++j) {
        const Vec3 d = Vec3(0, -1 + (2 * i + 1.0) / kN, -1 + (2 * j + 1.0) / kN) - zone.points[p].position;
        const double r2 = glm::dot(d, d), height = glm::dot(d, zone.points[p].normal);
        if (height > 0.0) lx += 100.0 * -d.x / std::sqrt(r2) * height / (r2 * std::sqrt(r2)) / (kN * kN);
      }
    }
    CAPTURE(p);
    CHECK(light.point_lx[p] == Approx(lx).epsilon(1e-3));
  }
}

TEST_CASE("Cells along a luminous wall have what their points have, at every size", "[direct][validation]") {
  const double cell_m = GENERATE(0.25, 0.1, 0.05);
  const bool lambertian = GENERATE(true, false);
  Zone zone;
  zone.diameter_m = 8.0;
  add_surface(zone, "floor", {{0, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {0, 0.5, 0}}, add_grey(zone, 0.0), cell_m);
  Lights lights;
  // The wall x = 0, 3 m wide and 2.5 m high, meets the floor's edge.
  add_lamp(lights, "wall", {0, 0, 1.25}, lambertian ? IntensityTable::lambertian(100.0) : IntensityTable::isotropic(100.0),
           {.aim = {1, 0, 0}, .opening = rectangle(3.0, 2.5)});
  lights.luminaires[0].c0 = {0, 1, 0};
  lights.luminaires[0].c90 = glm::cross(lights.luminaires[0].c0, lights.luminaires[0].aim);
  const auto light = test::direct(zone, lights);
  const Cells cells(zone);
  double squares = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].centroid.x > cell_m) continue;  // of the row along the wall, by its local frame's u
    const Receiver receiver = cell_receiver(zone, cells, i);
    const Vec3 middle = receiver.ring.middle();
    if (middle.x > cell_m) continue;
    double lx = 0.0;
    constexpr int kCell = 24, kWall = 600;
    for (int a = 0; a < kCell; ++a) {
      const double a0 = static_cast<double>(a) / kCell, a1 = (a + 1.0) / kCell;
      const double x = 0.5 * cell_m * (a0 * a0 + a1 * a1), weight = a1 * a1 - a0 * a0;
      for (int h = 0; h < kWall; ++h) {
        // Narrow near the floor, as the distance is.
        const double t0 = static_cast<double>(h) / kWall, t1 = (h + 1.0) / kWall;
        const double z0 = 2.5 * t0 * t0 * t0, z1 = 2.5 * t1 * t1 * t1, z = 0.5 * (z0 + z1), s2 = x * x + z * z;
        const auto along = [&](double y) {  // integral over y of x z / r^4 or z / r^3
          return lambertian ? 0.5 * (y / (s2 * (s2 + y * y)) + std::atan(y / std::sqrt(s2)) / (s2 * std::sqrt(s2))) * x * z
                            : z * y / (s2 * std::sqrt(s2 + y * y));
        };
        lx += 100.0 / 7.5 * (along(1.5 - middle.y) - along(-1.5 - middle.y)) * (z1 - z0) * weight;
      }
    }
    squares += std::pow(light.cell_lx[i] / lx - 1.0, 2);
    ++n;
  }
  CAPTURE(cell_m, lambertian);
  REQUIRE(n > 3);
  CHECK(std::sqrt(squares / n) < 1e-2);
}

TEST_CASE("Beams of a quarter of a degree keep their flux", "[direct][validation]") {
  IntensityDistribution beam;
  beam.c_rad = {0.0, 2 * kPi};
  for (int i = 0; i <= 50; ++i) beam.gamma_rad.push_back(radians(0.05 * i));
  for (int plane = 0; plane < 2; ++plane) {
    for (int i = 0; i <= 50; ++i) beam.intensity_cd.push_back(i < 50 ? 1e4 * std::exp(-std::pow(0.05 * i / 0.3, 2)) : 0.0);
  }
  const IntensityTable table(beam);
  const double cell_m = GENERATE(0.1, 0.5, 2.0), size_m = GENERATE(0.0, 0.1);
  const Zone zone = box_zone({4, 4, 3}, 0.0, cell_m);
  Lights lights;
  add_lamp(lights, "spot", {-1, 0, 1}, table, {.aim = {0.05, 0.1, -1}, .opening = rectangle(size_m, size_m)});
  const auto light = test::direct(zone, lights);
  const Cells cells(zone);
  double lm = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) lm += cells.area_m2(i) * light.cell_lx[i];
  CAPTURE(cell_m, size_m);
  CHECK(lm == Approx(table.flux_lm()).epsilon(1e-3));
  // First flights are drawn from the beam.
  CHECK(flights_of(zone, lights, 4096)[0].flux_lm == Approx(table.flux_lm()).epsilon(1e-3));
}

TEST_CASE("However few the lines, the visible share has no bias", "[direct][validation]") {
  // A box before a luminous floor, seen from a cell of the ceiling: of a pair halved often each part has few lines.
  Zone zone = box_zone({4.1, 3.3, 2.6}, 0.0, 0.2);
  add_box(zone, "box.", {-0.9, -0.6, -0.5}, {0.4, 0.5, 0.3}, 0, 0.2, true);
  const Cells cells(zone);
  Lights lights;
  add_lamp(lights, "floor", {0, 0, -1.3}, IntensityTable::lambertian(94.7),
           {.aim = {0, 0, 1}, .opening = rectangle(4.1, 3.3)});
  const Obstructions obstructions(zone, lights);
  const auto sources = own_sources(zone, lights);
  std::size_t cell = cells.first(1);
  const auto away = [&](std::size_t i) {
    return glm::length(zone.surfaces[1].polygon.frame().to_world(cells[i].centroid) - Vec3(-0.2, -0.58, 1.3));
  };
  for (std::size_t i = cells.first(1); i < cells.first(2); ++i) cell = away(i) < away(cell) ? i : cell;
  struct Mean {
    double lx, deviation_lx;
  };
  const auto mean_of = [&](int lines, int n) {
    PairOptions options;
    options.shadow_lines = lines;
    const auto integrators = make_integrators(zone, sources, obstructions, options);
    Receiver receiver = cell_receiver(zone, cells, cell);
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < n; ++k) {
      receiver.stream = mix(static_cast<std::uint64_t>(k) + 1);
      const double lx = integrators[0].mean(receiver).lx;
      sum += lx;
      squares += lx * lx;
    }
    return Mean{sum / n, std::sqrt((squares / n - sum * sum / n / n) / n)};
  };
  const Mean exact = mean_of(8192, 100);
  for (const int lines : {16, 64, 128, 256}) {
    const Mean few = mean_of(lines, 6000);
    CAPTURE(lines, few.lx, few.deviation_lx, exact.lx, exact.deviation_lx);
    CHECK(std::abs(few.lx - exact.lx) <= 4.0 * (few.deviation_lx + exact.deviation_lx));
    CHECK(few.deviation_lx < 2e-3 * exact.lx);
  }
}
