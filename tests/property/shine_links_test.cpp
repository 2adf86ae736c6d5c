// Light by direction link by link: energy to rounding, lobes' incoming light against the rows, mirrors
// against sums over images and closed integrals.
#include <array>
#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "property/shine_rooms.hpp"
#include "transport/shine_memory.hpp"

using namespace dim;
using namespace dim::test;

namespace {

// Rooms of every kind of shine, some of them open.
Zone shiny_room_of_kind(int kind) {
  Zone zone = shiny_room(0.5, 0.7);
  if (kind == 0 || kind == 2 || kind == 5) make_glossy(zone, kFloor, 0.5, 0.2, 2.0);
  if (kind == 1 || kind == 2) make_mirror(zone, kX0, 0.8, 0.4).ior = SpectralCurve(3.0);
  if (kind == 2) make_mirror_of(zone, kY0, 0.9);
  if (kind == 3) {  // glossy beside glossy, and a box of mirrors
    make_glossy(zone, kFloor, 0.8, 0.3, 3.0);
    make_glossy(zone, kY1, 0.6, 0.15, 1.5, 0.2).specular_reflectance = SpectralCurve(0.7);
    make_mirror_of(zone, kX1, 0.95);
    add_box(zone, "block", {-0.6, -0.5, -1.25}, {0.3, 0.4, -0.4}, zone.surfaces[kX1].finish, 0.7, true);
  }
  if (kind == 4) {  // open above and to one side, mirrors that throw light out
    make_glossy(zone, kFloor, 0.5, 0.2, 2.0);
    make_mirror_of(zone, kX0, 0.9);
    zone.surfaces.erase(zone.surfaces.begin() + kY1);
    zone.surfaces.erase(zone.surfaces.begin() + kCeiling);
  }
  if (kind == 5) {  // spectral: two classes
    make_mirror(zone, kX0).specular_reflectance =
        SpectralCurve({{380, 0.3}, {580, 0.4}, {581, 0.9}, {780, 0.95}});
    finish_of(zone, kFloor).ior = SpectralCurve({{380, 1.4}, {580, 1.4}, {581, 3.0}, {780, 3.0}});
  }
  return zone;
}

double view_of(const Vec3& from, const Vec3& normal_from, const Vec3& to, const Vec3& normal_to) {
  const Vec3 d = to - from;
  const double r2 = glm::dot(d, d);
  return std::max(0.0, glm::dot(normal_from, d)) * std::max(0.0, -glm::dot(normal_to, d)) / (r2 * r2);
}

double glass(double n, double cosine) {
  const double t = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
  const double s = (cosine - n * t) / (cosine + n * t), p = (t - n * cosine) / (t + n * cosine);
  return (s * s + p * p) / 2.0;
}

}  // namespace

TEST_CASE("Energy closes to rounding with lobes, mirrors, families, open zones and odd grids",
          "[shine][property]") {
  const int kind = GENERATE(0, 1, 2, 3, 4, 5);
  const bool family = GENERATE(false, true);
  const auto patches = GENERATE(PatchGrid{9, 21}, PatchGrid{7, 15}, PatchGrid{8, 16});
  CAPTURE(kind, family, patches.n_slices, patches.n_sectors);
  ShineProblem problem(shiny_room_of_kind(kind), network_options(patches, family), 3, kind == 5 ? 2 : 1);
  REQUIRE(problem.classes.size() == (kind == 5 ? 2U : 1U));
  const std::size_t n = problem.n_columns();
  const auto psi = random_values(problem.direct.psi.size(), 5);
  std::transform(psi.begin(), psi.end(), problem.direct.psi.begin(),
                 [](double x) { return static_cast<float>(x / 300.0); });
  const auto direct = Columns<double>::from_rows(random_values(problem.cells.size() * n, 7), n);
  const auto shine = problem.gather_shine();
  for (const double tolerance : {1e-1, 1e-5}) {
    GatherOptions options;
    options.tolerance = tolerance;
    const auto gathered = gather(problem.network, problem.cells, direct, Columns<double>(0, n),
                                 problem.reflectances, options, Job{}, &shine);
    for (const auto& column : gathered.columns) {
      const double spent = column.absorbed + column.escaped + column.dropped + column.unbalanced;
      CAPTURE(tolerance, column.received, column.absorbed, column.escaped, column.dropped, column.unbalanced);
      CHECK(std::abs(spent - column.received) <= 1e-6 * column.received);
      CHECK(column.absorbed > 0.0);
      CHECK(column.escaped >= (kind == 4 ? 0.1 : -1e-12) * column.received);
    }
  }
}

TEST_CASE("What comes in on a lobe is what is gathered there, taken apart by direction",
          "[shine][property]") {
  const int kind = GENERATE(0, 2, 3, 4, 5);
  const bool family = GENERATE(false, true);
  const auto patches = GENERATE(PatchGrid{9, 21}, PatchGrid{8, 16}, PatchGrid{32, 64});
  CAPTURE(kind, family, patches.n_slices, patches.n_sectors);
  ShineProblem problem(shiny_room_of_kind(kind), network_options(patches, family), 1, kind == 5 ? 2 : 1);
  const auto psi = random_values(problem.direct.psi.size(), 5);
  std::transform(psi.begin(), psi.end(), problem.direct.psi.begin(),
                 [](double x) { return static_cast<float>(x / 300.0); });
  const std::size_t width = kColumnsPerLane, n = problem.n_columns();
  auto exitance = random_values((problem.cells.size() + 1) * width, 7);
  std::fill(exitance.end() - static_cast<std::ptrdiff_t>(width), exitance.end(), 0.0);
  const auto state = problem.state(width);
  const auto arriving = problem.arriving(state, exitance, width);
  std::vector<double> phi;
  for (std::size_t g = 0; g < problem.shine.n_off_specular(); ++g) {
    state.incoming(g, exitance, phi);
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0.0;
      for (std::size_t p = 0; p < problem.shine.grid().n_patches(); ++p) sum += phi[p * n + c];
      REQUIRE(sum == Approx(arriving[problem.shine.off_specular()[g] * width + c]).epsilon(1e-9));
    }
  }
}

TEST_CASE("Light comes in on a lobe's grid, however coarse, where its source is seen", "[shine][unit]") {
  // A cell a third of the way up a wall, seen from the middle of a floor of one cell.
  const auto patches = GENERATE(PatchGrid{32, 64}, PatchGrid{37, 83}, PatchGrid{16, 32}, PatchGrid{9, 21});
  Zone zone = shiny_room(0.5, 0.5);
  zone.surfaces[kFloor].grid = {1, 1};
  make_glossy(zone, kFloor, 0.5, 0.3, 2.0);
  for (auto& p : {kY0, kX1}) zone.surfaces[std::size_t(p)].grid = {6, 6};
  NetworkOptions options = network_options(patches);
  options.sampling = Sampling::centre;
  const ShineProblem problem(zone, options);
  CAPTURE(patches.n_slices, patches.n_sectors);
  const PatchGrid& grid = problem.shine.grid();
  const auto state = problem.state(kColumnsPerLane);
  const Frame& floor = problem.zone.surfaces[kFloor].polygon.frame();
  for (const int face : {kY0, kX1}) {
    const Frame& wall = problem.zone.surfaces[std::size_t(face)].polygon.frame();
    for (std::size_t j = problem.cells.first(std::size_t(face));
         j < problem.cells.first(std::size_t(face) + 1); ++j) {
      std::vector<double> exitance((problem.cells.size() + 1) * kColumnsPerLane, 0.0), phi;
      exitance[j * kColumnsPerLane] = 1.0;
      state.incoming(0, exitance, phi);
      Vec3 mean(0.0);
      for (std::size_t p = 0; p < grid.n_patches(); ++p)
        mean += phi[p] * grid.centre(int(p) / grid.n_sectors, int(p) % grid.n_sectors);
      if (glm::length(mean) == 0.0) continue;
      const Vec3 centre = floor.to_world(problem.cells[0].centroid);
      const Vec3 to =
          floor.direction_to_local(glm::normalize(wall.to_world(problem.cells[j].centroid) - centre));
      // Sector from sector: a turn by one would be 2 pi / n_sectors.
      const double turn = std::remainder(std::atan2(mean.y, mean.x) - std::atan2(to.y, to.x), 2 * kPi);
      CAPTURE(face, j, turn);
      CHECK(std::abs(turn) < 0.75 * 2 * kPi / grid.n_sectors + 0.06);
      CHECK(std::abs(glm::normalize(mean).z - to.z) < 0.75 / grid.n_slices + 0.06);
    }
  }
}

TEST_CASE("A lobe grid is covered by the network's rays, each lobe patch once", "[shine][unit]") {
  const auto patches = GENERATE(PatchGrid{63, 127}, PatchGrid{37, 83}, PatchGrid{32, 64}, PatchGrid{16, 32},
                                PatchGrid{7, 15}, PatchGrid{1, 4000}, PatchGrid{3000, 1});
  Zone zone = shiny_room(0.5, 2.0);
  make_glossy(zone, kFloor, 0.5, 0.3, 2.0);
  const Cells cells(zone);
  Network network;
  network.patches = patches;
  const auto classes = classify(zone, Bands::uniform(1));
  const auto of_surface = shininess_of_surfaces(zone, classes, lobe_grid(patches));
  const LobeStates states(zone, cells, network, of_surface);
  CAPTURE(patches.n_slices, patches.n_sectors, states.grid().n_slices, states.grid().n_sectors);
  CHECK(states.n_patches() <= kMostLobePatches);
  CHECK((4 * states.n_patches() >= std::min(kMostLobePatches, patches.n_patches()) / 2));
  std::vector<double> share(states.n_patches(), 0.0);
  for (std::size_t k = 0; k < patches.n_patches(); ++k) share[states.patch_of(k)] += states.share_of(k);
  for (const double s : share) CHECK(s == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("Diffuse light in two mirrors of glass is that of its images, each mirror at its own angle",
          "[shine][validation]") {
  // A lit panel in the floor, mirrors of different glass at right angles, everything else black.
  Zone zone = shiny_room(0.0, 1.0, {4, 4, 3});
  make_mirror(zone, kX0).ior = SpectralCurve(1.5);
  make_mirror(zone, kY0).ior = SpectralCurve(4.0);
  const int panel_finish = add_grey(zone, 0.9);
  // The point looks towards the edge between the mirrors; both are met at some 60 degrees.
  const Vec3 at(0.6, 0.5, 0.2), normal = glm::normalize(Vec3(-1, -1, -0.3));
  zone.points.push_back({at, normal});
  const Vec3 lo(-1.0, -1.2, -1.4), hi(0.2, 0.2, -1.4);
  add_surface(zone, "panel", {{lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z}},
              panel_finish, 1.0);
  zone.surfaces.back().bounding = false;
  NetworkOptions options = network_options({16, 32});
  options.point_patches = {512, 1024};  // one ray in a hundred finds the panel by a mirror
  const ShineProblem problem(zone, options);
  const std::size_t panel = problem.zone.surfaces.size() - 1, width = kColumnsPerLane;
  std::vector<double> exitance((problem.cells.size() + 1) * width, 0.0);
  for (std::size_t i = problem.cells.first(panel); i < problem.cells.first(panel + 1); ++i)
    exitance[i * width] = kPi;
  std::vector<double> found(width, 0.0);
  problem.state(width).add_to_points(exitance, found);

  // Images in x0 (x -> -4 - x), in y0 (y -> -4 - y), and in both, either way round: which one is met first
  // depends on the direction.
  const std::array<double, 2> index{1.5, 4.0};
  double expected = 0.0, both = 0.0;
  constexpr int kN = 200;
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j < kN; ++j) {
      const Vec3 q(lo.x + (hi.x - lo.x) * (i + 0.5) / kN, lo.y + (hi.y - lo.y) * (j + 0.5) / kN, lo.z);
      for (const int mirrors : {1, 2, 3}) {
        const Vec3 image(mirrors & 1 ? -4 - q.x : q.x, mirrors & 2 ? -4 - q.y : q.y, q.z);
        const Vec3 d = glm::normalize(image - at);
        double tint = 1.0;
        if (mirrors & 1) tint *= glass(index[0], std::abs(d.x));
        if (mirrors & 2) tint *= glass(index[1], std::abs(d.y));
        const double part =
            tint * view_of(at, normal, image, {0, 0, 1}) * (hi.x - lo.x) * (hi.y - lo.y) / (kN * kN);
        expected += part;
        if (mirrors == 3) both += part;
      }
    }
  }
  CAPTURE(both);
  CHECK(both > 0.02 * expected);
  CHECK(found[0] == Approx(expected).epsilon(0.01));
}

TEST_CASE("A shaft of mirrors passes light on as its unfolded lattice says", "[shine][validation]") {
  // Four mirror walls of 0.95, half a metre apart and three metres deep: rays meet up to hundreds of them.
  const double f = 0.95, w = 0.5, h = 3.0;
  Zone zone = shiny_room(0.5, 0.25, {w, w, h});
  for (const int face : {kY0, kY1, kX0, kX1}) make_mirror_of(zone, face, f);
  const Vec3 at(0.05, -0.1, h / 2);
  zone.points.push_back({at, {0, 0, -1}});
  NetworkOptions options = network_options({16, 32});
  options.point_patches = {512, 1024};  // one ray in a hundred finds the panel by a mirror
  const ShineProblem problem(zone, options);
  const std::size_t width = kColumnsPerLane;
  std::vector<double> exitance((problem.cells.size() + 1) * width, 0.0);
  for (std::size_t i = problem.cells.first(kFloor); i < problem.cells.first(kFloor + 1); ++i)
    exitance[i * width] = 1.0;
  std::vector<double> found(width, 0.0);
  const auto state = problem.state(width);
  state.add_to_points(exitance, found);
  // Every ray ends on the floor after as many mirrors as there are lattice planes between.
  double expected = 0.0, direct = 0.0, deep = 0.0;
  constexpr int kTheta = 2000, kPhi = 720;
  for (int i = 0; i < kTheta; ++i) {
    const double cos2 = (i + 0.5) / kTheta, tangent = std::sqrt(1.0 - cos2) / std::sqrt(cos2);
    for (int j = 0; j < kPhi; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / kPhi;
      const double x = at.x + h * tangent * std::cos(phi), y = at.y + h * tangent * std::sin(phi);
      const int met = int(std::abs(std::round(x / w)) + std::abs(std::round(y / w)));
      const double part = std::pow(f, met) / (kTheta * kPhi);
      expected += part;
      if (met == 0) direct += part;
      if (met > 16) deep += part;
    }
  }
  CAPTURE(direct, deep);
  CHECK(deep > 0.03);  // what following no more than sixteen would lose
  CHECK(found[0] == Approx(expected - direct).epsilon(5e-3));
  CHECK(problem.shine.cut_off() < 1e-4);
  CHECK(problem.shine.cut_off() > 0.0);

  // Of the walls' reflectance, all light is accounted for: what is cut is in the balance.
  auto after = problem.state(width);
  after.reflect(std::vector<double>(exitance.size(), 0.0));
  const auto power = after.power(exitance);
  CHECK(power.cut[0] > 0.0);
  CHECK(power.cut[0] < 1e-4 * w * w);
  CHECK(power.escaped[0] == 0.0);
}

TEST_CASE("A lobe lit from everywhere lights cells as measuring points see it", "[shine][property]") {
  // Cells are sent to down the lobe's rays, points look along theirs: two ways that share nothing but psi.
  const auto patches = GENERATE(PatchGrid{16, 32}, PatchGrid{32, 64}, PatchGrid{15, 31});
  Zone zone = shiny_room(0.0, 0.5);
  make_glossy(zone, kFloor, 1.0, 0.25, 4.0, 0.0);
  const Cells cells_before(zone);
  for (const int face : {kCeiling, kX1}) {
    const auto s = std::size_t(face);
    const Frame& frame = zone.surfaces[s].polygon.frame();
    for (std::size_t i = cells_before.first(s); i < cells_before.first(s + 1); ++i)
      zone.points.push_back({frame.to_world(cells_before[i].centroid) + 1e-6 * frame.n, frame.n});
  }
  NetworkOptions options = network_options(patches);
  options.point_patches = {32, 64};
  const ShineProblem problem(zone, options);
  const std::size_t width = kColumnsPerLane;
  auto state = problem.state(width);
  std::vector<double> exitance((problem.cells.size() + 1) * width, 0.0);
  for (std::size_t i = problem.cells.first(kCeiling); i < problem.cells.first(kCeiling + 1); ++i)
    exitance[i * width] = 1.0;
  state.reflect(exitance);
  std::fill(exitance.begin(), exitance.end(), 0.0);
  const auto on_cells = problem.arriving(state, exitance, width);
  std::vector<double> at_points(problem.zone.points.size() * width, 0.0);
  state.add_to_points(exitance, at_points);
  std::size_t point = 0;
  for (const int face : {kCeiling, kX1}) {
    double of_cells = 0.0, of_points = 0.0;
    const auto s = std::size_t(face);
    for (std::size_t i = problem.cells.first(s); i < problem.cells.first(s + 1); ++i, ++point) {
      of_cells += problem.cells.area_m2(i) * on_cells[i * width];
      of_points += problem.cells.area_m2(i) * at_points[point * width];
    }
    CAPTURE(face, patches.n_slices);
    CHECK(of_cells == Approx(of_points).epsilon(0.02));
  }
}

TEST_CASE("Radiance by direction adds up to what the lobe reflects, at grazing incidence too",
          "[shine][unit]") {
  // The share of light that a glossy floor reflects by its lobe grows sixfold from normal to 75 degrees.
  for (const double theta : {0.1, 0.9, 1.3}) {
    Zone zone = shiny_room(0.0, 0.5);
    zone.surfaces[kFloor].grid = {1, 1};
    make_glossy(zone, kFloor, 0.8, 0.1, 1.5, 0.0);
    zone.finishes.front().diffuse = SpectralCurve(0.0);
    const Vec3 lamp = Vec3(0, 0, -1.25) + 1.2 * Vec3(std::sin(theta), 0.0, std::cos(theta));
    // A floor of 20 cm, so that the angle is one.
    zone.surfaces[kFloor].polygon =
        Polygon(Ring3{{-0.1, -0.1, -1.25}, {0.1, -0.1, -1.25}, {0.1, 0.1, -1.25}, {-0.1, 0.1, -1.25}});
    const auto solution = solve(zone, point_lamp(lamp, 100.0), network_of(zone, {16, 32}));
    REQUIRE(solution.directional.cells.size() == 1);
    const PatchGrid& grid = solution.directional.grid;
    double sum = 0.0;
    for (std::size_t p = 0; p < grid.n_patches(); ++p)
      sum += static_cast<double>(solution.directional.direct[p]) * grid.weight_sr(int(p) / grid.n_sectors);
    const auto reflection = band_reflection(finish_of(zone, kFloor), 380, 780);
    const Facets facets(FacetDistribution::gaussian, 0.1);
    const double expected = specular_albedo(reflection, &facets, std::cos(theta)) *
                            static_cast<double>(solution.cell_direct[solution.directional.cells[0]]);
    CAPTURE(theta);
    CHECK(sum == Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("A finish is a mirror where its lobe is narrower than a patch, and not before", "[shine][unit]") {
  const auto shininess = [](double m, const PatchGrid& patches) {
    Zone zone = shiny_room(0.5, 1.0);
    make_glossy(zone, kFloor, 0.4, m, 1.5);
    return shininess_of_surfaces(zone, classify(zone, Bands::uniform(1)), lobe_grid(patches))[kFloor];
  };
  // 2m against the radius of a patch: sqrt(2 / 512) = 0.0625 on 16x32, twice that on 8x16.
  CHECK(shininess(0.031, {16, 32}) == Shininess::mirror);
  CHECK(shininess(0.0315, {16, 32}) == Shininess::off_specular);
  CHECK(shininess(0.062, {8, 16}) == Shininess::mirror);
  CHECK(shininess(0.063, {8, 16}) == Shininess::off_specular);
  CHECK(shininess(0.0315, {32, 64}) == Shininess::off_specular);
}

TEST_CASE("Links need no more memory than was told before", "[shine][unit]") {
  const int kind = GENERATE(0, 1, 2, 3, 4, 5);
  const bool family = GENERATE(false, true);
  const ShineProblem problem(shiny_room_of_kind(kind), network_options({8, 16}, family), 1,
                             kind == 5 ? 2 : 1);
  const auto told = shine_memory(problem.zone, problem.cells, problem.network, problem.classes,
                                 problem.caster, MirrorRayOptions{}, problem.n_columns());
  const auto& links = problem.shine.links();
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  const std::size_t used = bytes(links.mirror) + bytes(links.mirror_tint) + bytes(links.mirror_scale) +
                           bytes(links.passed) + bytes(links.lobe) + bytes(links.lobe_by_mirror) +
                           bytes(links.lobe_tint) + bytes(links.lobe_loss) + bytes(links.lobe_loss_tint);
  const std::size_t chunk = std::size_t{16} << 20;
  CAPTURE(kind, family, told.links, used);
  CHECK(told.links >= chunk);
  CHECK(told.links - chunk >= used);
  CHECK((told.light > 0) == (problem.shine.n_states() > 0));
  CHECK(told.n_off_specular == problem.shine.n_off_specular());
}
