// Direct light by way of mirrors against sums over images that share no code with the program.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "catch.hpp"
#include "image/render.hpp"
#include "property/transport_support.hpp"
#include "reflection/specular.hpp"
#include "light/light_source.hpp"
#include "transport/image_series.hpp"

using namespace dim;
using namespace dim::test;

namespace {

enum Face { kFloor, kCeiling, kY0, kY1, kX0, kX1 };

// A closed box with its lower corner at the origin, a finish a face.
Zone room(const Vec3& size_m, double reflectance, double cell_m = 0.5) {
  Zone zone;
  zone.name = "box";
  zone.diameter_m = glm::length(size_m);
  zone.closed = true;
  add_box(zone, "", {0, 0, 0}, size_m, add_grey(zone, reflectance), cell_m);
  for (auto& surface : zone.surfaces) surface.finish = add_grey(zone, reflectance);
  return zone;
}

Finish& finish_of(Zone& zone, int surface) {
  return zone.finishes[static_cast<std::size_t>(zone.surfaces[static_cast<std::size_t>(surface)].finish)];
}

Finish& make_mirror(Zone& zone, int surface, double diffuse = 0.0) {
  Finish& finish = finish_of(zone, surface);
  finish.specular = 1.0;
  finish.diffuse = SpectralCurve(diffuse);
  finish.roughness = 0.0;
  return finish;
}

void make_mirror_of(Zone& zone, int surface, double reflectance) {
  make_mirror(zone, surface).specular_reflectance = SpectralCurve(reflectance);
}

// Unpolarised reflectance of glass of index n, from the angle of refraction.
double glass(double n, double cosine) {
  const double t = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  const double s = (cosine - n * t) / (cosine + n * t), p = (t - n * cosine) / (t + n * cosine);
  return (s * s + p * p) / 2.0;
}

double lx_of(const Vec3& p, const Vec3& n, const Vec3& lamp, double cd) {
  const Vec3 d = lamp - p;
  return cd * std::max(0.0, glm::dot(n, d)) / std::pow(glm::length(d), 3);
}

// A coordinate after |i| reflections in the planes 0 and size, the sign of i saying which is seen last.
double unfolded(double x, double size, int i) { return i % 2 == 0 ? i * size + x : (i + 1) * size - x; }

// Every image of a point source in the walls of a box room: each is seen from every point, in one sequence of
// mirrors. `depth` mirrors in all, those along x of `fx`, along y of `fy`.
double lattice_lx(const Vec3& size, const Vec3& lamp, double cd, const Vec3& p, const Vec3& n, double fx,
                  double fy, int depth) {
  double sum = 0.0;
  for (int i = -depth; i <= depth; ++i) {
    if (i != 0 && fx == 0.0) continue;
    const int rest = depth - std::abs(i);
    for (int j = -rest; j <= rest; ++j) {
      if (j != 0 && fy == 0.0) continue;
      const Vec3 image(unfolded(lamp.x, size.x, i), unfolded(lamp.y, size.y, j), lamp.z);
      sum += std::pow(fx, std::abs(i)) * std::pow(fy, std::abs(j)) * lx_of(p, n, image, cd);
    }
  }
  return sum;
}

double worst_imbalance(const Solution& solution) {
  double worst = 0.0;
  for (const auto& source : solution.sources) {
    for (const auto& energy : source.energy) worst = std::max(worst, std::abs(energy.imbalance));
  }
  return worst;
}

double dropped_share(const Solution& solution) {
  double most = 0.0;
  for (const auto& source : solution.sources) {
    for (const auto& energy : source.energy) most = std::max(most, energy.dropped_W / energy.emitted_W);
  }
  return most;
}

double surface_mean(const Zone& zone, int surface, const std::vector<double>& lx) {
  const Cells cells(zone);
  const auto s = static_cast<std::size_t>(surface);
  double sum = 0.0, area = 0.0;
  for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i) {
    sum += cells.area_m2(i) * lx[i];
    area += cells.area_m2(i);
  }
  return sum / area;
}

// Mean of a function over a rectangle at height z: midpoints.
double mean_over(const Vec2& size, const std::function<double(double, double)>& f, int n = 64) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) sum += f((i + 0.5) / n * size.x, (j + 0.5) / n * size.y);
  }
  return sum / (n * n);
}

const Vec3 kSize(4, 4, 3);

void add_points(Zone& zone) {
  zone.points = {{{3.0, 2.0, 0.0}, {0, 0, 1}},
                 {{1.0, 1.0, 0.0}, {0, 0, 1}},
                 {{2.0, 2.0, 1.5}, {1, 0, 0}},
                 {{2.0, 3.9, 2.0}, {0, -1, 0}},
                 {{0.1, 0.2, 0.9}, {0, 0, 1}}};
}

}  // namespace

TEST_CASE("Between facing mirrors every point has the infinite sum of images", "[mirror][validation]") {
  Zone zone = room(kSize, 0.0);
  make_mirror_of(zone, kX0, 0.9);
  make_mirror_of(zone, kX1, 0.9);
  add_points(zone);
  const Vec3 lamp(1, 2, 1.5);
  const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone, {4, 8}));
  const auto lx = point_lx(solution);
  // As given with the case: 2000 orders by another program.
  const std::vector<double> given = {13.9225, 33.7504, 6.4383, 23.4293};
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const double exact =
        lattice_lx(kSize, lamp, 100.0, zone.points[i].position, zone.points[i].normal, 0.9, 0.0, 600);
    if (i < given.size()) CHECK(exact == Approx(given[i]).epsilon(1e-5));
    CAPTURE(i);
    CHECK(lx[i] == Approx(exact).epsilon(5e-4));
  }
  const double exact = mean_over({4, 4}, [&](double x, double y) {
    return lattice_lx(kSize, lamp, 100.0, {x, y, 0}, {0, 0, 1}, 0.9, 0.0, 200);
  });
  CHECK(surface_mean(zone, kFloor, cell_lx(solution)) == Approx(exact).epsilon(2e-3));
  CHECK(worst_imbalance(solution) < 2e-3);
  CHECK(dropped_share(solution) < 1e-4);
  CHECK(solution.mirrors.uncertain <= 3e-4);
}

TEST_CASE("Four mirror walls of 0.95 light points and surfaces as the lattice of images",
          "[mirror][validation]") {
  Zone zone = room(kSize, 0.0);
  for (const int face : {kY0, kY1, kX0, kX1}) make_mirror_of(zone, face, 0.95);
  add_points(zone);
  const Vec3 lamp(1, 1.3, 2.0);
  const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone, {4, 8}));
  const auto lx = point_lx(solution);
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const double exact =
        lattice_lx(kSize, lamp, 100.0, zone.points[i].position, zone.points[i].normal, 0.95, 0.95, 150);
    CAPTURE(i);
    CHECK(lx[i] == Approx(exact).epsilon(3e-4));
    CHECK(std::abs(lx[i] / exact - 1.0) <= solution.mirrors.uncertain);
  }
  const auto cells = cell_lx(solution);
  for (const auto& [face, z, n] : {std::tuple(kFloor, 0.0, 1.0), std::tuple(kCeiling, 3.0, -1.0)}) {
    const double height = z, up = n;
    const double exact = mean_over(
        {4, 4},
        [&](double x, double y) {
          return lattice_lx(kSize, lamp, 100.0, {x, y, height}, {0, 0, up}, 0.95, 0.95, 100);
        },
        32);
    CHECK(surface_mean(zone, face, cells) == Approx(exact).epsilon(5e-3));
  }
  CHECK(worst_imbalance(solution) < 2e-3);
  CHECK(dropped_share(solution) < 1e-4);
  CHECK(solution.mirrors.n_rays > 0);
}

TEST_CASE("Images are made to the depth asked for, and what is left out at points is said",
          "[mirror][unit]") {
  Zone zone = room(kSize, 0.0);
  make_mirror_of(zone, kX0, 0.8);
  make_mirror_of(zone, kX1, 0.8);
  add_points(zone);
  const Vec3 lamp(1, 2, 1.5);
  for (const int depth : {0, 1, 2, 5, 40}) {
    SimulationOptions options;
    options.mirror_depth = depth;
    const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone, {4, 8}), options);
    CAPTURE(depth);
    double most = 0.0;
    for (std::size_t i = 0; i < zone.points.size(); ++i) {
      const auto& p = zone.points[i];
      const double exact = lattice_lx(kSize, lamp, 100.0, p.position, p.normal, 0.8, 0.0, depth);
      CHECK(point_lx(solution)[i] == Approx(exact).epsilon(1e-6));
      const double all = lattice_lx(kSize, lamp, 100.0, p.position, p.normal, 0.8, 0.0, 300);
      most = std::max(most, 1.0 - exact / all);
    }
    CHECK(solution.mirrors.deepest() == depth);
    if (depth < 5) CHECK(solution.mirrors.uncertain > 0.02);
    if (depth == 40) CHECK(solution.mirrors.uncertain < 1e-4);
    // Flux is kept whatever the depth.
    CHECK(worst_imbalance(solution) < 2e-3);
    CHECK(dropped_share(solution) < 1e-4);
  }
}

TEST_CASE("Followed by rays, light comes down where images would bring it", "[mirror][property]") {
  Zone zone = room(kSize, 0.0);
  for (const int face : {kY0, kY1, kX0, kX1}) make_mirror_of(zone, face, 0.9);
  const auto lights = point_lamp({1, 1.3, 2.0}, 100.0);
  const Network network = network_of(zone, {4, 8});
  SimulationOptions by_rays, by_images;
  by_rays.mirror_depth = GENERATE(0, 1, 2);
  by_images.mirror_depth = 12;
  const auto rays = solve(zone, lights, network, by_rays), images = solve(zone, lights, network, by_images);
  CHECK(rays.mirrors.deepest() == *by_rays.mirror_depth);
  CHECK(rays.mirrors.rays_share > 0.1);
  const auto a = cell_lx(rays), b = cell_lx(images);
  for (int face = 0; face < 6; ++face)
    CHECK(surface_mean(zone, face, a) == Approx(surface_mean(zone, face, b)).epsilon(3e-3));
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(a[i] / b[i] - 1.0, 2);
  CHECK(std::sqrt(square / static_cast<double>(a.size())) < 0.02);
  CHECK(worst_imbalance(rays) < 2e-3);
  // The direct light that is stored is that of images.
  CHECK(surface_mean(zone, kFloor, cell_direct_lx(rays)) < 0.99 * surface_mean(zone, kFloor, a));
}

TEST_CASE("A mirror sees a fitting from its other side", "[mirror][unit]") {
  // Intensity that no symmetry hides: different towards C0, C90, C180 and C270. Light that leaves the lamp
  // towards a mirror goes where the straight line to the mirrored point goes.
  std::vector<double> c, gamma, cd;
  for (int i = 0; i <= 4; ++i) c.push_back(i * kPi / 2);
  for (int g = 0; g <= 6; ++g) gamma.push_back(g * kPi / 6);
  const std::vector<double> plane = {100.0, 900.0, 300.0, 2100.0, 100.0};
  for (const double of_plane : plane) {
    for (int g = 0; g <= 6; ++g) cd.push_back(of_plane * (1.0 + g));
  }
  const IntensityTable table({c, gamma, cd});
  Zone zone = room(kSize, 0.0);
  const auto mirrors = GENERATE(std::vector<int>{kX0}, std::vector<int>{kY1}, std::vector<int>{kX0, kY1},
                                std::vector<int>{kX1, kY0, kCeiling});
  for (const int face : mirrors) make_mirror_of(zone, face, 0.8);
  for (int i = 0; i < 8; ++i)
    zone.points.push_back(
        {{0.4 + 0.43 * i, 0.7 + 0.35 * i, 0.2 + 0.1 * i}, glm::normalize(Vec3(0.3, -0.2, 1))});
  Lights lights;
  add_lamp(lights, "lamp", {1.3, 2.1, 1.7}, table, {.aim = {0.2, 0.1, -1.0}});
  auto& lamp = lights.luminaires.back();
  const double turn = 0.7;
  const Vec3 c0 = lamp.c0, c90 = lamp.c90;
  lamp.c0 = std::cos(turn) * c0 + std::sin(turn) * c90;
  lamp.c90 = glm::cross(lamp.c0, lamp.aim);
  const auto lx = point_lx(solve(zone, lights, network_of(zone, {4, 8})));
  // Non-parallel walls of a box: every subset of the mirrors gives one image.
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    double exact = 0.0;
    for (unsigned subset = 0; subset < 1U << mirrors.size(); ++subset) {
      Vec3 p = zone.points[i].position, n = zone.points[i].normal;
      double factor = 1.0;
      for (std::size_t m = 0; m < mirrors.size(); ++m) {
        if (!(subset >> m & 1U)) continue;
        const auto axis = static_cast<glm::length_t>(
            mirrors[m] == kCeiling ? 2 : (mirrors[m] == kY0 || mirrors[m] == kY1 ? 1 : 0));
        const double at = mirrors[m] == kX0 || mirrors[m] == kY0 ? 0.0 : kSize[axis];
        p[axis] = 2.0 * at - p[axis];
        n[axis] = -n[axis];
        factor *= 0.8;
      }
      const Vec3 d = p - lamp.at;
      const double r = glm::length(d);
      exact += factor * table.at(lamp.to_local(d)) * std::max(0.0, -glm::dot(n, d)) / (r * r * r);
    }
    CAPTURE(i, mirrors.size());
    CHECK(lx[i] == Approx(exact).epsilon(1e-6));
  }
}

TEST_CASE("Each mirror takes its own share at its own angle", "[mirror][unit]") {
  // Two glasses whose planes meet at 110 degrees, of different index: no order and no angle can be exchanged.
  Zone zone;
  zone.name = "wedge";
  zone.diameter_m = 20.0;
  for (int i = 0; i < 3; ++i) add_grey(zone, 0.0);
  const double tilt = radians(110.0);
  const Vec3 up(std::cos(tilt), 0, std::sin(tilt));
  const Ring3 a = {{0, -4, 0}, {8, -4, 0}, {8, 4, 0}, {0, 4, 0}};
  const Ring3 b = {{0, -4, 0}, {0, 4, 0}, Vec3(0, 4, 0) + 8.0 * up, Vec3(0, -4, 0) + 8.0 * up};
  add_surface(zone, "a", a, 1, 1.0);
  add_surface(zone, "b", b, 2, 1.0);
  make_mirror(zone, 0).ior = SpectralCurve(1.5);
  make_mirror(zone, 1).ior = SpectralCurve(2.6);
  const Vec3 normal_a(0, 0, 1), normal_b = glm::normalize(glm::cross(Vec3(0, 8, 0), up));
  REQUIRE(glm::dot(zone.surfaces[1].polygon.normal(), normal_b) > 0.999);
  // Seen from the common edge the lamp is low over one glass or the other, so that either comes first.
  const auto at_angle = [](double angle_deg, double radius_m, double y) {
    return Vec3(radius_m * std::cos(radians(angle_deg)), y, radius_m * std::sin(radians(angle_deg)));
  };
  const Vec3 lamp = at_angle(GENERATE(20.0, 90.0), 2.4, 0.3);
  for (const double angle : {10.0, 25.0, 40.0, 55.0, 70.0, 85.0, 100.0}) {
    for (const double radius : {1.1, 2.6}) {
      zone.points.push_back({at_angle(angle, radius, -0.9), {0, 0, 1}});
      zone.points.push_back({at_angle(angle, radius, 0.8), glm::normalize(Vec3(-1, 0.2, -0.5))});
    }
  }
  const auto lx = point_lx(solve(zone, point_lamp(lamp, 100.0), network_of(zone, {4, 8})));
  struct Mirror {
    Vec3 normal, up, side;  // through the origin; `up` from the common edge
    double n;
  };
  const std::vector<Mirror> glasses = {{normal_a, {1, 0, 0}, {0, 1, 0}, 1.5}, {normal_b, up, {0, 1, 0}, 2.6}};
  const std::vector<std::vector<std::size_t>> sequences = {{}, {0}, {1}, {0, 1}, {1, 0}};
  int n_double = 0;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    double exact = 0.0;
    for (const auto& sequence : sequences) {
      // The lamp's light aims at the point mirrored in the last mirror, then the one before ...
      Vec3 target = zone.points[i].position;
      for (auto m = sequence.rbegin(); m != sequence.rend(); ++m)
        target -= 2.0 * glm::dot(target, glasses[*m].normal) * glasses[*m].normal;
      Vec3 from = lamp, along = target - lamp;
      const double r = glm::length(along);
      along /= r;
      double factor = 1.0;
      for (const auto m : sequence) {
        const Mirror& mirror = glasses[m];
        const double cosine = -glm::dot(along, mirror.normal), t = glm::dot(from, mirror.normal) / cosine;
        const Vec3 hit = from + t * along;
        const double h = glm::dot(hit, mirror.up), s = glm::dot(hit, mirror.side);
        factor *= cosine > 0 && t > 1e-9 && h > 0 && h < 8 && std::abs(s) < 4 ? glass(mirror.n, cosine) : 0.0;
        from = hit;
        along += 2.0 * cosine * mirror.normal;
      }
      // Nothing else in the way: what goes on behind a mirror's plane before the point does not count.
      exact += factor * 100.0 * std::max(0.0, -glm::dot(along, zone.points[i].normal)) / (r * r);
      n_double += factor > 0.0 && sequence.size() == 2 && glm::dot(along, zone.points[i].normal) < 0.0;
    }
    CAPTURE(i);
    CHECK(lx[i] == Approx(exact).epsilon(1e-6));
  }
  CHECK(n_double >= 4);
}

TEST_CASE("No image is left out that light takes, and no beam too narrow", "[mirror][property]") {
  // A room with a mirror on a box, a leaning mirror and mirror walls; a lamp with an extent.
  Zone zone = room(kSize, 0.3);
  add_box(zone, "block", {1.5, 1.2, 0}, {2.4, 2.0, 1.1}, 0, 0.5, true);
  add_surface(zone, "leaning", {{2.5, 0.4, 0.1}, {3.6, 0.4, 0.1}, {3.6, 0.1, 1.9}, {2.5, 0.1, 1.9}},
              add_grey(zone, 0.0), 0.5);
  // "leaning" faces the room; its back is another matter.
  if (glm::dot(zone.surfaces.back().polygon.normal(), Vec3(0, 1, 0)) < 0.0)
    zone.surfaces.back().polygon = zone.surfaces.back().polygon.reversed();
  const std::vector<int> mirrors = {kX0, kX1, kY1, 6 + 3, 6 + 5, static_cast<int>(zone.surfaces.size()) - 1};
  Lights lights;
  const bool upright = GENERATE(false, true);
  const LuminousOpening opening =
      upright ? LuminousOpening{OpeningShape::kVerticalEllipse, 0.0, 0.5, 0.8} : rectangle(1.2, 0.4);
  add_lamp(lights, "lamp", {1.2, 2.6, 2.2},
           upright ? IntensityTable::isotropic(1.0) : IntensityTable::lambertian(1.0),
           {.aim = {0.3, -0.2, -1}, .opening = opening});
  constexpr int kDepth = 3;
  const auto made = sources_with_images(zone, lights, mirrors, {kDepth});
  const RayCaster caster(plates_of(zone), zone.diameter_m);
  // Every sequence of mirrors, its image made by hand.
  std::vector<LightSource> all = own_sources(zone, lights);
  std::size_t first = 0;
  for (int depth = 0; depth < kDepth; ++depth) {
    const std::size_t last = all.size();
    for (; first < last; ++first) {
      for (const int mirror : mirrors) {
        LightSource image = all[first];
        const Vec3 n = zone.surfaces[static_cast<std::size_t>(mirror)].polygon.normal();
        image.luminaire.at = mirrored(zone, mirror, image.luminaire.at);
        for (Vec3* axis : {&image.luminaire.c0, &image.luminaire.c90, &image.luminaire.aim})
          *axis -= 2.0 * glm::dot(*axis, n) * n;
        image.mirrors.push_back(mirror);
        image.beam = {};
        all.push_back(image);
      }
    }
  }
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t n_paths = 0, n_kept = 0;
  for (const auto& image : all) {
    const auto found =
        std::find_if(made.begin(), made.end(), [&](const LightSource& e) { return e.mirrors == image.mirrors; });
    n_kept += found != made.end();
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = kSize * Vec3(unit(random), unit(random), unit(random));
      const Vec3 q =
          image.luminaire.at + image.luminaire.to_world(sample(opening, {unit(random), unit(random)}));
      if (!(image.fitting->intensity.at(image.luminaire.to_local(p - q)) > 0.0)) continue;
      if (path_blocked(zone, caster, image, p, q, -1)) continue;
      ++n_paths;
      REQUIRE(found != made.end());
      REQUIRE_FALSE(found->beam.misses({&p, 1}, 0.0));
    }
  }
  CHECK(n_paths > 500);
  CHECK(n_kept == made.size());
  CHECK(2 * made.size() < all.size());
}

TEST_CASE("The beam of a point through an aperture is its pyramid", "[mirror][unit]") {
  const Ring3 aperture = {{1, 1, 0}, {3, 1, 0}, {3, 2, 0}, {1, 2, 0}};
  const Vec3 apex(2.2, 0.4, -1.5);
  const Beam beam = beam_through(aperture, {0, 0, 1}, {&apex, 1});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int n_in = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(2.0 + 4.0 * unit(random), 1.5 + 4.0 * unit(random), 2.0 * unit(random));
    const Vec3 at = apex + 1.5 / (p.z + 1.5) * (p - apex);
    const bool in = p.z > 0.0 && at.x > 1 && at.x < 3 && at.y > 1 && at.y < 2;
    n_in += in;
    CHECK(beam.misses({&p, 1}, 0.0) == !in);
  }
  CHECK(n_in > 50);
  const Ring2 hull = convex_hull({{0, 0}, {2, 0}, {1, 0.5}, {2, 1}, {0, 1}, {1, 0}, {0.5, 0.5}});
  CHECK(hull == Ring2{{0, 0}, {2, 0}, {2, 1}, {0, 1}});
}

TEST_CASE("A picture shaded point by point shows what fine cells show", "[mirror][image][validation]") {
  // Direct light at each pixel in place of the cells' own, images as deep as the solution had them, what rays
  // carried on from there with the rest.
  const auto depth = GENERATE(std::optional<int>(0), std::optional<int>(1), std::optional<int>());
  const auto picture = [&](double cell_m, Shading shading, const std::optional<int>& mirror_depth) {
    Zone zone = room(kSize, 0.4, cell_m);
    make_mirror_of(zone, kX0, 0.9);
    make_mirror_of(zone, kX1, 0.9);
    SimulationOptions options;
    options.mirror_depth = mirror_depth;
    const auto lights = point_lamp({1, 1.3, 2.0}, 100.0);
    const auto solution = solve(zone, lights, network_of(zone, {8, 16}), options);
    const LuminanceDatabase database(zone, Cells(zone), lights, solution);
    RenderOptions render;
    render.view.eye = {2.2, 3.6, 1.6};
    render.view.focus = {1.8, 1.4, 0.0};
    render.view.fov_rad = radians(60.0);
    render.view.width = 24;
    render.view.height = 18;
    render.samples = 2;
    render.shading = shading;
    render.scalar = ScalarQuantity::luminance;
    return render_view(database, Cells(database.zone()), {1.0}, render, Job{});
  };
  const Raster gathered = picture(0.25, Shading::gather, depth), fine = picture(0.1, Shading::cell, {});
  double mean = 0.0, mean_fine = 0.0, square = 0.0;
  for (std::size_t i = 0; i < fine.n_pixels(); ++i) {
    const auto a = static_cast<double>(gathered.scalar[i]), b = static_cast<double>(fine.scalar[i]);
    mean += a;
    mean_fine += b;
    square += std::pow(a / b - 1.0, 2);
  }
  CHECK(mean == Approx(mean_fine).epsilon(5e-3));
  CHECK(std::sqrt(square / static_cast<double>(fine.n_pixels())) < 0.03);
}

TEST_CASE("A tail of images is told within what is said to be uncertain", "[mirror][unit]") {
  const double f = GENERATE(0.3, 0.8, 0.95, 0.999);
  const double exponent = GENERATE(1.5, 2.0, 3.0);
  const bool alternating = GENERATE(false, true);
  std::vector<double> by_order;
  double tail = 0.0;
  constexpr int kMade = 24;
  for (int n = 1; n < 200000; ++n) {
    const double term = std::pow(f, n) * std::pow(n + 0.7, -exponent) * (alternating && n % 2 ? 0.3 : 1.0);
    if (n <= kMade) by_order.push_back(term);
    if (n > kMade) tail += term;
  }
  CAPTURE(f, exponent, alternating);
  const ImageTail told = tail_of_images(by_order, f);
  CHECK(std::abs(told.lx - tail) <= told.uncertain_lx);
  // Blocks in place of orders: good to a tenth.
  CHECK(told.lx == Approx(tail).epsilon(alternating ? 0.15 : 0.1));
  // Too few to tell: nothing is added, and the bound holds.
  const ImageTail early = tail_of_images(std::span(by_order).first(3), f);
  double after_three = tail;
  for (std::size_t n = 3; n < by_order.size(); ++n) after_three += by_order[n];
  CHECK(early.lx == 0.0);
  if (!alternating) CHECK(early.uncertain_lx >= after_three);
  CHECK(tail_of_images({}, f).uncertain_lx == 0.0);
}

TEST_CASE("What hides a mirror from a light hides the light in the mirror", "[mirror][unit]") {
  // The way from the lamp to the mirror at x = 0 passes x = 1 at y = 1.75, the way on to the point at y = 2.25.
  const auto lx = [](double reflectance, double low_y, double high_y) {
    Zone zone = room(kSize, 0.0);
    if (reflectance > 0.0) make_mirror_of(zone, kX0, reflectance);
    for (const bool front : {true, false}) {
      Ring3 ring = {{1, low_y, 1}, {1, high_y, 1}, {1, high_y, 2}, {1, low_y, 2}};
      if (!front) std::reverse(ring.begin(), ring.end());
      add_surface(zone, front ? "screen" : "screen back", ring, 0, 0.5);
      zone.surfaces.back().bounding = false;
      zone.surfaces.back().twin = front ? 7 : 6;
    }
    zone.points = {{{2, 2.5, 1.5}, {0, -1, 0}}};
    return point_lx(solve(zone, point_lamp({2, 1.5, 1.5}, 100.0), network_of(zone, {2, 4})))[0];
  };
  const double alone = lx(0.0, 0.2, 0.4);
  CHECK(lx(0.9, 0.2, 0.4) > 1.01 * alone);
  CHECK(lx(0.9, 1.6, 1.9) == Approx(alone).epsilon(1e-9));
  CHECK(lx(0.9, 2.1, 2.4) == Approx(alone).epsilon(1e-9));
}

TEST_CASE("Energy closes with mirrors that something stands between", "[mirror][property]") {
  Zone zone = room(kSize, 0.5);
  for (const int face : {kX0, kX1, kY1}) make_mirror_of(zone, face, 0.92);
  finish_of(zone, kX0).specular_reflectance = SpectralCurve({{400, 0.6}, {550, 0.8}, {700, 0.95}});
  finish_of(zone, kX1).diffuse = SpectralCurve(0.3);
  finish_of(zone, kX1).specular = 0.7;
  add_box(zone, "block", {1.5, 1.2, 0}, {2.4, 2.0, 1.1}, 0, 0.5, true);
  Lights lights = point_lamp({1, 1.3, 2.0}, 100.0);
  add_lamp(lights, "panel", {2.6, 2.9, 2.9}, IntensityTable::lambertian(100.0),
           {.opening = rectangle(0.6, 0.6)});
  finish_of(zone, kFloor).specular = GENERATE(0.0, 0.5);
  finish_of(zone, kFloor).roughness = 0.25;
  finish_of(zone, kFloor).ior = SpectralCurve(1.8);
  SimulationOptions options;
  options.bands = Bands::uniform(3);
  options.mirror_depth = GENERATE(std::optional<int>(), std::optional<int>(1));
  const auto solution = solve(zone, lights, network_of(zone, {16, 32}), options);
  CHECK(solution.mirrors.n_rays > 0);
  CHECK(worst_imbalance(solution) < 2e-3);
}

TEST_CASE("Images and what follows them give the same bits on any number of threads", "[mirror][property]") {
  const auto run = [](std::size_t n_threads) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n_threads);
    Zone zone = room(kSize, 0.4);
    for (const int face : {kX0, kX1, kY1}) make_mirror_of(zone, face, 0.9);
    finish_of(zone, kFloor).specular = 0.3;
    finish_of(zone, kFloor).roughness = 0.25;
    finish_of(zone, kFloor).ior = SpectralCurve(1.8);
    add_points(zone);
    Lights lights = point_lamp({1, 1.3, 2.0}, 100.0);
    add_lamp(lights, "panel", {2.6, 2.9, 2.9}, IntensityTable::lambertian(100.0),
             {.opening = rectangle(0.6, 0.6)});
    return solve(zone, lights, network_of(zone, {8, 16}));
  };
  const auto one = run(1), many = run(4);
  CHECK(one.cell_total == many.cell_total);
  CHECK(one.point_total == many.point_total);
  CHECK(one.directional.total == many.directional.total);
}

TEST_CASE("What mirrors bring of a source does not depend on other sources", "[mirror][property]") {
  Zone zone = room(kSize, 0.0);
  for (const int face : {kX0, kX1, kY1}) make_mirror_of(zone, face, 0.9);
  add_points(zone);
  const Network network = network_of(zone, {4, 8});
  const auto panel = [](Lights& lights) {
    add_lamp(lights, "panel", {2.6, 2.9, 2.9}, IntensityTable::lambertian(100.0),
             {.opening = rectangle(0.6, 0.6)});
  };
  Lights alone, company = point_lamp({1, 1.3, 2.0}, 5000.0);
  panel(alone);
  panel(company);
  const auto a = solve(zone, alone, network), b = solve(zone, company, network);
  CHECK(cell_lx(a) == cell_lx(b, 1));
  CHECK(point_lx(a) == point_lx(b, 1));
}
