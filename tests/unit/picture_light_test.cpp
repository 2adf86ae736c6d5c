// What pictures are made of: light between cells, direct light at pixels, and which pixels have edges.
#include <random>

#include "catch.hpp"
#include "geometry/perspective.hpp"
#include "image/cell_blend.hpp"
#include "image/edge_mask.hpp"
#include "image/lens.hpp"
#include "image/render.hpp"
#include "property/transport_support.hpp"
#include "scene/joints.hpp"
#include "unit/scene_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

struct Blended {
  Zone zone;
  Cells cells;
  CellBlend blend;
  explicit Blended(Zone z) : zone(std::move(z)), cells(zone), blend(zone, cells, find_joints(zone)) {}

  // At a point in space of whichever of the surfaces holds it.
  double at(const std::vector<double>& values, const Vec3& p) const {
    for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
      const Polygon& polygon = zone.surfaces[s].polygon;
      const Vec2 local = polygon.frame().to_local(p);
      if (std::abs(polygon.frame().height(p)) > 1e-9 || !polygon.contains(local)) continue;
      double sum = 0.0, weights = 0.0;
      blend.visit(s, local, [&](std::size_t cell, double weight) {
        sum += weight * values[cell];
        weights += weight;
      });
      CHECK(weights == Approx(1.0));
      return sum;
    }
    return -1.0;
  }
};

std::vector<double> noise(std::size_t n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> values(n);
  for (double& value : values) value = uniform(random);
  return values;
}

}  // namespace

TEST_CASE("Light on a wall is continuous across features cut out of it, and round their corners", "[image][unit]") {
  const Blended wall(read(kRoom + R"([[surface]]
name = "board"
finish = "dark"
on = "south"
vertices = [[1.3,0,0.7],[1.3,0,1.9],[3.1,0,1.9],[3.1,0,0.7]]
[[surface]]
name = "notice"
finish = "dark"
on = "south"
cell = 0.2
vertices = [[3.1,0,1],[3.1,0,1.6],[3.5,0,1.6],[3.5,0,1]]
)"));
  const auto values = noise(wall.cells.size());
  const Vec3 middle = -wall.zone.origin_m;  // the file's origin
  constexpr double kStep_m = 1e-4;
  // The steepest that interpolated noise can be: two cells of 0.2 m differ by 1 and their weights by as much.
  constexpr double kMost = 40.0 * kStep_m;
  for (const double z : {0.3, 0.71, 1.25, 1.6, 1.88, 2.4}) {
    double before = wall.at(values, middle + Vec3(0.5, 0, z));
    double worst = 0.0;
    for (double x = 0.5 + kStep_m; x < 5.5; x += kStep_m) {
      const double now = wall.at(values, middle + Vec3(x, 0, z));
      worst = std::max(worst, std::abs(now - before));
      before = now;
    }
    CHECK(worst < kMost);
  }
}

TEST_CASE("Light does not blend through a partition that stands on a floor", "[image][unit]") {
  const Blended room(read(kRoom + R"([[surface]]
name = "partition"
finish = "wall"
sides = 2
vertices = [[2.2,0,0],[2.2,4,0],[2.2,4,3],[2.2,0,3]]
)"));
  const double x_m = 2.2 - room.zone.origin_m.x;
  std::vector<double> values;
  for (std::size_t c = 0; c < room.cells.size(); ++c) {
    const Frame& frame = room.zone.surfaces[room.cells.surface_of(c)].polygon.frame();
    values.push_back(frame.to_world(room.cells[c].centroid).x > x_m ? 1.0 : 0.0);
  }
  for (double x = 0.01; x < 6.0; x += 0.0237)
    CHECK(std::abs(room.at(values, Vec3(x, 1.37, 0.0) - room.zone.origin_m) - (x > 2.2 ? 1.0 : 0.0)) < 1e-12);
}

TEST_CASE("Pixels without an edge show one surface", "[image][property]") {
  const Zone zone = furnished_room(0.5, 0.7);
  const RayCaster caster(plates_of(zone), zone.diameter_m);
  View view;
  view.eye = {-2.7, -1.6, 0.2};
  view.focus = {1, 0.5, -0.5};
  view.fov_rad = 1.3;
  view.width = 160;
  view.height = 120;
  const Perspective camera(camera_of(view));
  const Lens lens(view);
  EdgeMask mask(view.width, view.height);
  for (const auto& surface : zone.surfaces)
    for (const auto& ring : surface.polygon.corners())
      for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) lens.mark_edge(ring[j], ring[i], 1e-6, mask);
  int n_without = 0, n_wrong = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (mask.at(x, y)) continue;
      ++n_without;
      const int plate = caster.nearest(camera.eye(), camera.direction(x + 0.5, y + 0.5)).plate;
      for (const double dx : {0.001, 0.5, 0.999})
        for (const double dy : {0.001, 0.5, 0.999})
          n_wrong += caster.nearest(camera.eye(), camera.direction(x + dx, y + dy)).plate != plate;
    }
  }
  CHECK(n_wrong == 0);
  CHECK(n_without > 160 * 120 * 3 / 4);
}

TEST_CASE("Direct light at pixels is what the integral gives, in blurred shadows and beside sharp ones",
          "[image][validation]") {
  const Zone zone = furnished_room(0.5, 0.7);
  Lights lights;
  add_lamp(lights, "panel", {0.3, 0.4, 1.3}, IntensityTable::lambertian(900.0), {.opening = rectangle(1.2, 0.6)});
  add_lamp(lights, "point", {-1.8, 0.9, 1.2}, IntensityTable::isotropic(150.0));
  Solution solution;
  for (const auto& luminaire : lights.luminaires) {
    Source source;
    source.name = source.group = luminaire.name;
    source.luminaires = {luminaire.name};
    source.flux_lm = 1.0;
    source.weights = band_weights(SpectralCurve(1.0), Bands{});
    solution.sources.push_back(source);
  }
  const Cells cells(zone);
  constexpr double kIndirect_lx = 60.0;
  solution.classes = classify(zone, solution.bands);
  solution.n_cells = cells.size();
  solution.cell_direct.assign(2 * cells.size(), 0.0F);
  solution.cell_total.assign(2 * cells.size(), static_cast<float>(kIndirect_lx / 2));
  const LuminanceDatabase database(zone, cells, lights, std::move(solution));
  RenderOptions options;
  options.view.eye = {-2.7, -1.6, 1.1};
  options.view.focus = {0.5, 0.2, -1.2};
  options.view.fov_rad = 1.2;
  options.view.width = 96;
  options.view.height = 72;
  options.shading = Shading::gather;
  options.samples = 3;
  const Raster raster = render_view(database, database.cells(), {1.0, 1.0}, options, Job{});

  const Obstructions obstructions(zone, lights);
  const auto emitters = own_sources(zone, lights);
  std::vector<PairIntegrator> exact;
  for (const auto& emitter : emitters)
    exact.emplace_back(zone, obstructions.caster(), obstructions.shadows(), emitter, PairOptions{.shadow_lines = 600});
  const Perspective camera({options.view.eye, options.view.focus, {0, 0, 1}, options.view.fov_rad, 96, 72});
  double squares = 0.0;
  int n = 0, n_off = 0;
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 96; ++x) {
      double sum = 0.0, low = 1e300, high = 0.0;
      for (const double dx : {0.5, 0.0, 1.0})
        for (const double dy : {0.5, 0.0, 1.0}) {
          const Hit hit = obstructions.caster().nearest(camera.eye(), camera.direction(x + dx, y + dy));
          Frame frame = zone.surfaces[static_cast<std::size_t>(hit.plate)].polygon.frame();
          frame.origin = frame.to_world(hit.local);
          double lx = kIndirect_lx;
          for (const auto& integrator : exact) lx += integrator.mean(point_receiver(frame, hit.plate, 1)).lx;
          sum += lx / 9;
          low = std::min(low, lx), high = std::max(high, lx);
        }
      if (high > 1.03 * low) continue;  // an edge or a sharp shadow passes through: nine points are not its mean
      const auto at = static_cast<std::size_t>(96 * y + x);
      const double error = static_cast<double>(raster.scalar[at]) / sum - 1.0;
      squares += error * error;
      n_off += std::abs(error) > 0.03;
      ++n;
    }
  }
  REQUIRE(n > 4000);
  CHECK(std::sqrt(squares / n) < 0.005);
  CHECK(n_off < n / 500);
}
