#include "network/network_storage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

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
                     std::size_t n_patches, std::size_t n_cells) {
  SinkTable sinks(n_rows, n_patches, n_cells);
  if (sinks.wide())
    file.read_rows(path, 0, n_rows, sinks.wide_entries());
  else
    file.read_rows(path, 0, n_rows, sinks.narrow());
  return sinks;
}

std::vector<double> load_column(const Hdf5Reader& file, const std::string& path, std::size_t n) {
  return file.dataset<double>(path, {n});
}

// Families share a sink's part of the row and no more: nothing is seen with a negative weight, and all of it
// together is what it was.
void check_shares(const Network& network, std::size_t n_cells, const std::string& name) {
  constexpr double kRounding = 1e-9;
  const auto& extra = network.extra;
  const auto n_sectors = static_cast<std::size_t>(network.patches.n_sectors);
  for (std::size_t i = 0; i < n_cells; ++i) {
    std::map<std::size_t, double> share;
    double sum = 0.0;
    for (auto e = extra.first[i]; e < extra.first[i + 1]; ++e) {
      share[extra.cell[e]] += extra.weight[e];
      sum += extra.weight[e];
    }
    if (share.empty()) continue;
    for (std::size_t k = 0; k < network.patches.n_patches(); ++k) {
      const auto sink = share.find(network.sinks.at(i, k));
      if (sink != share.end()) sink->second += network.patches.weight_sr(static_cast<int>(k / n_sectors)) / kPi;
    }
    const auto negative = std::find_if(share.begin(), share.end(), [](const auto& s) { return s.second < -kRounding; });
    if (negative != share.end() || std::abs(sum) > kRounding)
      throw IoError(name, fmt::format("dataset '/network/family/weight': the links of cell {} take more than its "
                                      "rays bring, or add up to {:g} in place of 0",
                                      i, sum));
  }
}

void load_extra(const Hdf5Reader& file, Network& network, std::size_t n_cells, const std::string& name) {
  if (!file.has("/network/family")) return;
  auto& extra = network.extra;
  extra.first = file.dataset<std::uint64_t>("/network/family/first", {n_cells + 1});
  extra.cell = file.dataset<std::uint32_t>("/network/family/cell", {kAnySize});
  extra.weight = file.dataset<double>("/network/family/weight", {extra.cell.size()});
  const bool good = std::is_sorted(extra.first.begin(), extra.first.end()) && extra.first.front() == 0 &&
                    extra.first.back() == extra.cell.size();
  if (!good)
    throw IoError(name, fmt::format("dataset '/network/family/first' does not ascend from 0 to {}",
                                    extra.cell.size()));
  check_shares(network, n_cells, name);
}

std::uint64_t load_seed(const Hdf5Reader& file, const std::string& name) {
  const std::string text = file.text_attribute("/network", "seed");
  std::uint64_t seed = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw IoError(name, "attribute 'seed' of '/network' is '" + text + "', no whole number");
  return seed;
}

PatchGrid load_patches(const Hdf5Reader& file, const std::string& prefix) {
  return {static_cast<int>(file.integer_attribute("/network", prefix + "slices")),
          static_cast<int>(file.integer_attribute("/network", prefix + "sectors"))};
}

// Refuses a file with fewer cells than its zone must have, before so many are made.
void check_cell_counts(const std::vector<std::uint32_t>& surface_of, const Zone& zone, const std::string& path) {
  std::vector<std::size_t> n(zone.surfaces.size(), 0);
  for (const auto surface : surface_of) ++n[surface];
  for (std::size_t s = 0; s < n.size(); ++s) {
    const Surface& surface = zone.surfaces[s];
    if (surface.outside && n[s] == 0) continue;
    // Squares that the polygon covers whole or in part: no fewer than its share of the rectangle.
    const Vec2 size = surface.polygon.size_m();
    const double least = n_squares(surface.polygon, surface.cell_m, surface.grid) *
                         std::min(1.0, surface.polygon.area_m2() / (size.x * size.y));
    if (surface.outside || least > static_cast<double>(n[s]) * (1.0 + 1e-9))
      throw IoError(path, fmt::format("dataset '/cells/surface' has {} cells on surface '{}', the zone asks for {:.0f}",
                                      n[s], surface.name, surface.outside ? 0.0 : std::ceil(least - 1e-6)));
  }
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
  check_cell_counts(surface, zone, path);
  check_cells_fit(zone, job.memory_limit_bytes);
  Cells cells(zone);
  constexpr double kSame = 1e-9;
  bool same = cells.size() == area.size();
  for (std::size_t i = 0; same && i < area.size(); ++i)
    same = cells.surface_of(i) == surface[i] && std::abs(cells.area_m2(i) - area[i]) <= kSame * area[i];
  if (!same)
    throw IoError(path, fmt::format("datasets '/cells/surface' and '/cells/area' hold {} cells that are not those of "
                                    "its zone; make it again",
                                    area.size()));
  return cells;
}

std::string save_rays(const std::string& path, const Zone& zone, const Cells& cells, const Network& network,
                      const Job& job) {
  Hdf5Writer file("rays", any_bodies_measure(zone) ? kRaysVersion : kPlanarRaysVersion);
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
  file.attribute("/network", "accuracy", network.accuracy);
  file.attribute("/network", "escaped_rays", network.n_escaped_rays);
  file.attribute("/network", "back_rays", network.n_back_rays);
  return std::move(file).write(path, job);
}

FileSchema cells_schema() {
  FileSchema cells;
  cells.datasets = {{"/cells/surface", "uint32", "cells", "1", Allowed::index, "surfaces"},
                    {"/cells/area", "float64", "cells", "m2", Allowed::positive},
                    {"/cells/centroid", "float64", "cells, 3", "m", Allowed::finite},
                    {"/cells/first_corner", "uint64", "cells+1"},
                    {"/cells/corner", "float64", "cell_corners, 2", "m", Allowed::finite}};
  return cells;
}

const FileSchema& rays_schema() {
  static const FileSchema schema = [] {
    constexpr double kMostPatches = 1e7, kMostRays = 1e18, kAnything = 1e300;
    FileSchema rays = zone_schema();
    rays.add(cells_schema());
    FileSchema network;
    for (const char* size : {"slices", "sectors", "point_slices", "point_sectors"})
      network.attributes.push_back({"/network", size, AttributeType::integer, 1, kMostPatches});
    for (const char* count : {"escaped_rays", "back_rays"})
      network.attributes.push_back({"/network", count, AttributeType::integer, 0, kMostRays});
    network.attributes.push_back({"/network", "imbalance", AttributeType::number, -kAnything, kAnything});
    network.attributes.push_back({"/network", "accuracy", AttributeType::number, 0.0, 0.5});
    network.attributes.push_back({"/network", "sampling", AttributeType::text});
    network.attributes.push_back({"/network", "seed", AttributeType::text});
    network.datasets = {
        {"/network/sinks", "uint16 or uint32", "cells, slices*sectors", "1", Allowed::index_or_end, "cells"},
        {"/network/point_sinks", "uint16 or uint32", "points, point_slices*point_sectors", "1",
         Allowed::index_or_end, "cells"},
        {"/network/visible", "float64", "cells", "1", Allowed::share},
        {"/network/row_scale", "float64", "cells", "1", Allowed::positive},
        {"/network/column_scale", "float64", "cells", "1", Allowed::positive},
        {"/network/point_back_fraction", "float64", "points", "1", Allowed::share},
        {"/network/family/first", "uint64", "cells+1", "1", Allowed::any, {}, true},
        {"/network/family/cell", "uint32", "links", "1", Allowed::index, "cells", true},
        {"/network/family/weight", "float64", "links", "1", Allowed::finite, {}, true}};
    return rays.add(network);
  }();
  return schema;
}

RaysFile load_rays(const std::string& path, const Job& job) {
  Hdf5Reader file(path, "rays", kRaysVersion, job, kPlanarRaysVersion);
  file.lay_against(rays_schema(), job.memory_limit_bytes);
  RaysFile rays;
  rays.hash = file.hash();
  rays.zone = load_zone(file, path);
  rays.cells = load_cells(file, rays.zone, path, job);
  const std::size_t n_cells = file.size("cells"), n_points = file.size("points");
  Network& network = rays.network;
  network.patches = load_patches(file, "");
  network.point_patches = load_patches(file, "point_");
  network.sampling =
      file.text_attribute("/network", "sampling") == "centre" ? Sampling::centre : Sampling::stratified;
  network.seed = load_seed(file, path);
  network.accuracy = file.number_attribute("/network", "accuracy");
  network.imbalance = file.number_attribute("/network", "imbalance");
  network.n_escaped_rays = static_cast<std::uint64_t>(file.integer_attribute("/network", "escaped_rays"));
  network.n_back_rays = static_cast<std::uint64_t>(file.integer_attribute("/network", "back_rays"));
  network.sinks = load_sinks(file, "/network/sinks", n_cells, network.patches.n_patches(), n_cells);
  network.point_sinks =
      load_sinks(file, "/network/point_sinks", n_points, network.point_patches.n_patches(), n_cells);
  network.visible = load_column(file, "/network/visible", n_cells);
  network.row_scale = load_column(file, "/network/row_scale", n_cells);
  network.column_scale = load_column(file, "/network/column_scale", n_cells);
  network.point_back_fraction = load_column(file, "/network/point_back_fraction", n_points);
  load_extra(file, network, n_cells, path);
  return rays;
}

}  // namespace dim
