// Inter-reflection on a given network: closed forms and a dense solution written for this test.
#include "transport/gather.hpp"

#include <algorithm>

#include "catch.hpp"
#include "network/balance.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

std::vector<double> reflectances(const Zone& zone, std::size_t n_columns = 1) {
  std::vector<double> rho;
  for (const auto& surface : zone.surfaces)
    for (std::size_t c = 0; c < n_columns; ++c)
      rho.push_back(zone.finishes[static_cast<std::size_t>(surface.finish)].diffuse.at(555));
  return rho;
}

Gathered gather_one(const Zone& zone, const Network& network, const std::vector<double>& direct,
                    const GatherOptions& options, const std::vector<double>& point_direct = {}) {
  std::vector<double> points = point_direct;
  points.resize(zone.points.size());
  return gather(network, Cells(zone), direct, points, reflectances(zone), 1, options, Job{});
}

// The matrix of the discrete problem, column by column: r_i F_ij c_j.
std::vector<std::vector<double>> matrix_of(const Network& network, std::size_t n) {
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n));
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> unit(n, 0.0);
    unit[j] = 1.0;
    const auto column = apply_rows(network, unit);
    for (std::size_t i = 0; i < n; ++i)
      matrix[i][j] = network.row_scale[i] * column[i] * network.column_scale[j];
  }
  return matrix;
}

// Gaussian elimination with partial pivoting.
std::vector<double> eliminate(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      if (factor == 0.0) continue;
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

std::vector<double> uneven(std::size_t n) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> lx(0.0, 100.0);
  std::vector<double> direct(n);
  for (auto& e : direct) e = lx(random);
  return direct;
}

}  // namespace

TEST_CASE("A uniform enclosure has E0 over 1 - rho everywhere", "[gather][unit]") {
  const double rho = GENERATE(0.2, 0.8);
  const auto [slices, sectors] = GENERATE(table<int, int>({{1, 1}, {2, 3}, {5, 10}, {16, 32}}));
  const double cell_m = GENERATE(0.37, 1.1, 10.0);
  const bool furnished = GENERATE(false, true);
  Zone zone = furnished ? furnished_room(rho, cell_m) : box_zone({5, 4, 3}, rho, cell_m);
  zone.points.push_back({{0.2, 0.1, 0.3}, {0, 0, 1}});
  zone.points.push_back({{0.2, 0.1, 0.3}, glm::normalize(Vec3(1, 2, -1))});
  const Network network = network_of(zone, {slices, sectors});
  const auto gathered = gather_one(zone, network, std::vector<double>(Cells(zone).size(), 40.0),
                                   {.tolerance = 1e-12}, {40.0, 40.0});
  CAPTURE(rho, slices, sectors, cell_m, furnished);
  double worst = 0.0;
  for (const double e : gathered.cell) worst = std::max(worst, std::abs(e * (1 - rho) / 40.0 - 1.0));
  for (const double e : gathered.point) worst = std::max(worst, std::abs(e * (1 - rho) / 40.0 - 1.0));
  CHECK(worst < 1e-6);
}

TEST_CASE("A uniform enclosure stays uniform with families", "[gather][unit]") {
  const Zone zone = furnished_room(0.6, 0.7);
  NetworkOptions options;
  options.patches = {3, 5};
  options.sampling = GENERATE(Sampling::centre, Sampling::stratified);
  options.family = true;
  const Network network = build_network(zone, Cells(zone), options, Job{});
  const auto gathered =
      gather_one(zone, network, std::vector<double>(Cells(zone).size(), 1.0), {.tolerance = 1e-12});
  for (const double e : gathered.cell) CHECK(e == Approx(2.5).epsilon(1e-6));
}

TEST_CASE("Gathering agrees with Gaussian elimination of the same network", "[gather][unit]") {
  const bool family = GENERATE(false, true);
  Zone zone = furnished_room(0.7, 1.1);
  zone.surfaces[0].finish = add_grey(zone, 0.2);
  zone.surfaces[3].finish = add_grey(zone, 0.95);
  zone.points.push_back({{0.2, 0.1, -0.3}, {0, 0, 1}});
  NetworkOptions options;
  options.patches = {4, 8};
  options.point_patches = {8, 16};
  options.family = family;
  const Cells cells(zone);
  const Network network = build_network(zone, cells, options, Job{});
  const std::size_t n = cells.size();
  const auto direct = uneven(n), rho = reflectances(zone);
  auto matrix = matrix_of(network, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) matrix[i][j] = (i == j) - matrix[i][j] * rho[cells.surface_of(j)];
  }
  const auto exact = eliminate(matrix, direct);
  const GatherOptions gather_options{.tolerance = GENERATE(3e-4, 1e-12)};
  const auto gathered = gather_one(zone, network, direct, gather_options, {5.0});
  const auto& report = gathered.columns[0];
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) mean += cells.area_m2(i) * exact[i] / area_m2(cells);
  double worst = 0.0;
  for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(gathered.cell[i] - exact[i]) / mean);
  CAPTURE(family, gather_options.tolerance, report.iterations);
  // The bound is a promise; elimination itself rounds at n times 1e-16.
  CHECK(worst <= report.error_bound * (1 + 1e-3) + 1e-12);
  CHECK(report.residual <= gather_options.tolerance);
  CHECK(report.error_bound == Approx(report.residual * 0.95 / 0.05));

  double at_point = 5.0;
  for (std::size_t k = 0; k < 128; ++k) {
    const auto j = network.point_sinks.at(0, k);
    REQUIRE(j < n);
    const double cosine = (static_cast<double>(k / 16) + 0.5) / 8.0;
    at_point += 2.0 * cosine / 128.0 * rho[cells.surface_of(j)] * gathered.cell[j];
  }
  CHECK(gathered.point[0] == Approx(at_point).epsilon(1e-12));
}

TEST_CASE("What is received is absorbed, escapes or is dropped", "[gather][unit]") {
  Zone zone = furnished_room(0.6, 0.9);
  if (GENERATE(false, true)) zone.surfaces.erase(zone.surfaces.begin() + 1);
  const Network network = network_of(zone, {6, 10});
  const auto direct = uneven(Cells(zone).size());
  for (const double tolerance : {0.1, 1e-3, 1e-12}) {
    const auto report = gather_one(zone, network, direct, {.tolerance = tolerance}).columns[0];
    CHECK(report.absorbed + report.escaped + report.dropped ==
          Approx(report.received).epsilon(1e-12 + 10.0 * network.imbalance));
    CHECK(report.received == Approx(total(Cells(zone), direct)).epsilon(1e-12));
    CHECK((report.escaped > 0.0) == network.is_open());
    // Dropped is what is still on its way and what rows and columns of the network disagree on.
    CHECK(std::abs(report.dropped) < (5 * tolerance + 2 * network.imbalance + 1e-12) * report.received);
  }
}

TEST_CASE("Black surfaces keep direct light as it is", "[gather][unit]") {
  const Zone zone = furnished_room(0.0, 0.9);
  const Network network = network_of(zone, {4, 8});
  const auto direct = uneven(Cells(zone).size());
  const auto gathered = gather_one(zone, network, direct, {});
  CHECK(gathered.cell == direct);
  CHECK(gathered.columns[0].error_bound == 0.0);
}

TEST_CASE("A zone reflecting 0.999 converges and keeps its bound", "[gather][unit]") {
  const Zone zone = box_zone({4, 3, 2.5}, 0.999, 0.5);
  const Network network = network_of(zone, {8, 16});
  const Cells cells(zone);
  const auto direct = uneven(cells.size());
  const auto gathered = gather_one(zone, network, direct, {.tolerance = 1e-8, .max_iterations = 100000});
  const double exact = 1000.0 * total(cells, direct) / area_m2(cells);
  const double mean = total(cells, gathered.cell) / area_m2(cells);
  // A thousand reflections carry the network's own imbalance, up to a thousand times it.
  const double allowed = gathered.columns[0].error_bound + 1000.0 * network.imbalance;
  CHECK(std::abs(mean / exact - 1.0) < allowed);
  CHECK(std::abs(mean / exact - 1.0) < 0.01);
}

TEST_CASE("Running out of iterations is told by the bound", "[gather][unit]") {
  const Zone zone = box_zone({4, 3, 2.5}, 0.9, 0.8);
  const Network network = network_of(zone, {4, 8});
  const auto direct = uneven(Cells(zone).size());
  const auto report = gather_one(zone, network, direct, {.tolerance = 1e-14, .max_iterations = 3}).columns[0];
  CHECK(report.iterations == 3);
  CHECK(report.residual > 1e-14);
  CHECK(report.error_bound == Approx(report.residual * 9.0));
}

TEST_CASE("Columns do not touch each other, however many there are", "[gather][unit]") {
  const Zone zone = furnished_room(0.7, 1.3);
  const Network network = network_of(zone, {4, 8});
  const Cells cells(zone);
  const std::size_t n = cells.size(), n_columns = GENERATE(1U, 7U, 8U, 9U, 32U, 33U, 70U);
  const auto base = uneven(n);
  std::vector<double> direct(n * n_columns);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < n_columns; ++c)
      direct[i * n_columns + c] = base[i] * static_cast<double>(1 << (c % 20));
  const GatherOptions options{.tolerance = 1e-13};
  const auto one = gather_one(zone, network, base, options);
  const auto all =
      gather(network, cells, direct, {}, reflectances(zone, n_columns), n_columns, options, Job{});
  // Powers of two: the same digits.
  bool same = true;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < n_columns; ++c)
      same = same && all.cell[i * n_columns + c] == one.cell[i] * static_cast<double>(1 << (c % 20));
  CAPTURE(n_columns);
  CHECK(same);
  CHECK(all.columns.size() == n_columns);
}
