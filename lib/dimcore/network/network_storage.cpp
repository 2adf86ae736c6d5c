#include "network/network_storage.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/zone_storage.hpp"

namespace dim {
namespace {

void store_sinks(Hdf5Writer& file, const std::string& path, const SinkTable& sinks, const std::string& what) {
  const Shape shape{sinks.n_rows(), sinks.n_patches()};
  if (sinks.wide())
    file.dataset(path, sinks.wide_entries(), shape, "1", what);
  else
    file.dataset(path, sinks.narrow(), shape, "1", what);
}

SinkTable load_sinks(const Hdf5Reader& file, const std::string& path, std::size_t n_rows,
                     std::size_t n_patches, std::size_t n_cells, const std::string& name) {
  if (file.shape(path) != Shape{n_rows, n_patches}) throw IoError(name, path + " is not [rows, patches]");
  SinkTable sinks(n_rows, n_patches, n_cells);
  if (sinks.wide())
    file.read_rows(path, 0, n_rows, sinks.wide_entries());
  else
    file.read_rows(path, 0, n_rows, sinks.narrow());
  const bool good = sinks.visit([&](const auto* entries) {
    const auto range = tbb::blocked_range<std::size_t>(0, sinks.n_rays(), 1 << 16);
    const std::size_t largest = tbb::parallel_reduce(
        range, std::size_t{0},
        [&](const auto& part, std::size_t so_far) {
          for (std::size_t i = part.begin(); i != part.end(); ++i)
            so_far = std::max<std::size_t>(so_far, entries[i]);
          return so_far;
        },
        [](std::size_t a, std::size_t b) { return std::max(a, b); });
    return largest <= n_cells;
  });
  if (!good) throw IoError(name, path + " names cells that do not exist");
  return sinks;
}

std::vector<double> load_column(const Hdf5Reader& file, const std::string& path, std::size_t n) {
  return file.dataset<double>(path, {n});
}

void load_extra(const Hdf5Reader& file, Network& network, std::size_t n_cells, const std::string& name) {
  if (!file.has("/network/family")) return;
  auto& extra = network.extra;
  extra.first = file.dataset<std::uint64_t>("/network/family/first", {n_cells + 1});
  extra.cell = file.dataset<std::uint32_t>("/network/family/cell", {kAnySize});
  extra.weight = file.dataset<double>("/network/family/weight", {extra.cell.size()});
  const bool good = std::is_sorted(extra.first.begin(), extra.first.end()) && extra.first.front() == 0 &&
                    extra.first.back() == extra.cell.size() &&
                    std::all_of(extra.cell.begin(), extra.cell.end(), [&](auto c) { return c < n_cells; });
  if (!good) throw IoError(name, "the family lists do not hold together");
}

// Scales multiply what is gathered and divide what points see: positive.
std::vector<double> load_scales(const Hdf5Reader& file, const std::string& path, std::size_t n,
                                const std::string& name) {
  auto scales = load_column(file, path, n);
  if (!std::all_of(scales.begin(), scales.end(), [](double s) { return s > 0.0 && std::isfinite(s); }))
    throw IoError(name, path + " is not positive");
  return scales;
}

std::uint64_t load_seed(const Hdf5Reader& file, const std::string& name) {
  const std::string text = file.text_attribute("/network", "seed");
  std::uint64_t seed = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw IoError(name, "its seed is not a number");
  return seed;
}

PatchGrid load_patches(const Hdf5Reader& file, const std::string& prefix, const std::string& name) {
  const auto a = file.integer_attribute("/network", prefix + "slices");
  const auto b = file.integer_attribute("/network", prefix + "sectors");
  if (a < 1 || b < 1 || a > 10'000'000 || b > 10'000'000) throw IoError(name, "a hemisphere without patches");
  return {static_cast<int>(a), static_cast<int>(b)};
}

}  // namespace

void store_cells(Hdf5Writer& file, const Zone& zone, const Cells& cells) {
  const std::size_t n = cells.size();
  std::vector<std::uint32_t> surface(n);
  std::vector<double> area(n), centroid;
  centroid.reserve(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    surface[i] = static_cast<std::uint32_t>(cells.surface_of(i));
    area[i] = cells.area_m2(i);
    const Vec3 c =
        zone.surfaces[cells.surface_of(i)].polygon.frame().to_world(cells[i].centroid) + zone.origin_m;
    centroid.insert(centroid.end(), {c.x, c.y, c.z});
  }
  file.dataset("/cells/surface", std::span<const std::uint32_t>(surface), {n}, "1",
               "index into /zone/surfaces");
  file.dataset("/cells/area", std::span<const double>(area), {n}, "m2");
  file.dataset("/cells/centroid", std::span<const double>(centroid), {n, 3}, "m", "in the zone file's axes");
  std::vector<std::uint64_t> first_corner{0};
  std::vector<double> corner;
  Ring2 outline;
  for (std::size_t i = 0; i < n; ++i) {
    cells.outline(i, outline);
    for (const auto& p : outline) corner.insert(corner.end(), {p.x, p.y});
    first_corner.push_back(corner.size() / 2);
  }
  file.dataset("/cells/first_corner", std::span<const std::uint64_t>(first_corner), {n + 1}, "1",
               "corners of cell i are first_i to first_i+1");
  file.dataset("/cells/corner", std::span<const double>(corner), {corner.size() / 2, 2}, "m",
               "in the surface's frame, counter-clockwise");
}

Cells load_cells(const Hdf5Reader& file, const Zone& zone, const std::string& path, const Job& job) {
  const auto area = file.dataset<double>("/cells/area", {kAnySize});
  const auto surface = file.dataset<std::uint32_t>("/cells/surface", {area.size()});
  check_cells_fit(zone, job.memory_limit_bytes);
  Cells cells(zone);
  constexpr double kSame = 1e-9;
  bool same = cells.size() == area.size();
  for (std::size_t i = 0; same && i < area.size(); ++i)
    same = cells.surface_of(i) == surface[i] && std::abs(cells.area_m2(i) - area[i]) <= kSame * area[i];
  if (!same)
    throw IoError(path, "its cells are not those that this version of DIM makes of its zone; make it again");
  return cells;
}

std::string save_rays(const std::string& path, const Zone& zone, const Cells& cells, const Network& network,
                      const Job& job) {
  Hdf5Writer file("rays", kRaysVersion);
  store_zone(file, zone);
  store_cells(file, zone, cells);
  const std::string sinks = "cell on which each patch's ray ends; the number of cells: on none";
  store_sinks(file, "/network/sinks", network.sinks, sinks);
  store_sinks(file, "/network/point_sinks", network.point_sinks, sinks);
  const auto column = [&](const std::string& name, const std::vector<double>& values,
                          const std::string& what) {
    file.dataset("/network/" + name, std::span<const double>(values), {values.size()}, "1", what);
  };
  column("visible", network.visible, "share of each cell's hemisphere that ends on cells");
  column("row_scale", network.row_scale, "makes rows and columns balance");
  column("column_scale", network.column_scale, "makes rows and columns balance");
  column("point_back_fraction", network.point_back_fraction,
         "share of a point's rays that met backs of surfaces");
  if (network.has_family()) {
    const auto& extra = network.extra;
    file.dataset("/network/family/first", std::span(extra.first), {extra.first.size()}, "1");
    file.dataset("/network/family/cell", std::span(extra.cell), {extra.cell.size()}, "1");
    file.dataset("/network/family/weight", std::span(extra.weight), {extra.weight.size()}, "1");
  }
  file.attribute("/network", "slices", network.patches.n_slices);
  file.attribute("/network", "sectors", network.patches.n_sectors);
  file.attribute("/network", "point_slices", network.point_patches.n_slices);
  file.attribute("/network", "point_sectors", network.point_patches.n_sectors);
  file.attribute("/network", "sampling", network.sampling == Sampling::centre ? "centre" : "stratified");
  file.attribute("/network", "seed", std::to_string(network.seed));
  file.attribute("/network", "imbalance", network.imbalance);
  file.attribute("/network", "escaped_rays", network.n_escaped_rays);
  file.attribute("/network", "back_rays", network.n_back_rays);
  return std::move(file).write(path, job);
}

RaysFile load_rays(const std::string& path, const Job& job) {
  const Hdf5Reader file(path, "rays", kRaysVersion, job, kRaysVersion);
  RaysFile rays;
  rays.hash = file.hash();
  rays.zone = load_zone(file, path);
  rays.cells = load_cells(file, rays.zone, path, job);
  const std::size_t n_cells = rays.cells.size(), n_points = rays.zone.points.size();
  Network& network = rays.network;
  network.patches = load_patches(file, "", path);
  network.point_patches = load_patches(file, "point_", path);
  network.sampling =
      file.text_attribute("/network", "sampling") == "centre" ? Sampling::centre : Sampling::stratified;
  network.seed = load_seed(file, path);
  network.imbalance = file.number_attribute("/network", "imbalance");
  network.n_escaped_rays = static_cast<std::uint64_t>(file.integer_attribute("/network", "escaped_rays"));
  network.n_back_rays = static_cast<std::uint64_t>(file.integer_attribute("/network", "back_rays"));
  network.sinks = load_sinks(file, "/network/sinks", n_cells, network.patches.n_patches(), n_cells, path);
  network.point_sinks =
      load_sinks(file, "/network/point_sinks", n_points, network.point_patches.n_patches(), n_cells, path);
  network.visible = load_column(file, "/network/visible", n_cells);
  network.row_scale = load_scales(file, "/network/row_scale", n_cells, path);
  network.column_scale = load_scales(file, "/network/column_scale", n_cells, path);
  network.point_back_fraction = load_column(file, "/network/point_back_fraction", n_points);
  load_extra(file, network, n_cells, path);
  return rays;
}

}  // namespace dim
