#include "network/network.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/meter.hpp"
#include "network/back_light.hpp"
#include "network/balance.hpp"
#include "network/family.hpp"
#include "network/landing.hpp"
#include "network/ray_pattern.hpp"

namespace dim {
namespace {

constexpr std::size_t kRaysPerBlock = 16384;

struct RowCounts {
  std::uint64_t escaped = 0;
  std::uint64_t back = 0;
};

class RowTracer {
 public:
  RowTracer(const Zone& zone, const Cells& cells)
      : zone_(zone), cells_(cells), caster_(plates_of(zone), zone.diameter_m) {}

  // Traces all rays of one row and hands each (patch, sink) to `store`.
  template <class Store, class OnBack>
  RowCounts trace(const RowRays& rays, const PatchGrid& patches, Store&& store, OnBack&& on_back) const {
    RowCounts counts;
    std::size_t patch = 0;
    for (int slice = 0; slice < patches.n_slices; ++slice) {
      const PatchSlice directions(patches, slice);
      for (int sector = 0; sector < patches.n_sectors; ++sector, ++patch) {
        const Ray ray = rays.ray(patches, directions, slice, sector);
        const Landing landing =
            landing_of(caster_.nearest(ray.from, ray.direction, rays.skip()), ray.direction, zone_, cells_);
        counts.escaped += landing.escaped;
        counts.back += landing.back;
        if (landing.back) on_back(patch, static_cast<std::size_t>(landing.surface));
        store(patch, landing.sink);
      }
    }
    return counts;
  }

 private:
  const Zone& zone_;
  const Cells& cells_;
  RayCaster caster_;
};

template <class RowFunction>
void for_rows(std::size_t n_rows, std::size_t n_patches, const char* stage, const Job& job, RowFunction&& f) {
  const std::size_t grain = std::max<std::size_t>(1, kRaysPerBlock / n_patches);
  Meter meter(job, stage, n_rows);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_rows, grain), [&](const auto& rows) {
    if (job.stopped()) return;
    for (std::size_t row = rows.begin(); row != rows.end(); ++row) f(row);
    meter.add(rows.size());
  });
  job.check();
}

void trace_cells(Network& network, const Zone& zone, const Cells& cells, const RowTracer& tracer,
                 const Job& job) {
  std::atomic<std::uint64_t> escaped{0}, back{0};
  BackLight on_backs(zone, cells, network.patches);
  for_rows(cells.size(), network.patches.n_patches(), "rays", job, [&](std::size_t cell) {
    const RowCounts counts =
        tracer.trace(RowRays(zone, cells, cell, network.sampling, network.seed), network.patches,
                     [&](std::size_t patch, std::uint32_t sink) { network.sinks.set(cell, patch, sink); },
                     [&](std::size_t patch, std::size_t surface) { on_backs.add(cell, patch, surface); });
    escaped += counts.escaped;
    back += counts.back;
  });
  network.n_escaped_rays = escaped;
  network.n_back_rays = back;
  network.back_share = on_backs.shares();
}

void trace_points(Network& network, const Zone& zone, const RowTracer& tracer, const Job& job) {
  const std::size_t n_patches = network.point_patches.n_patches();
  network.point_back_fraction.resize(zone.points.size());
  for_rows(zone.points.size(), n_patches, "points", job, [&](std::size_t point) {
    const RowCounts counts = tracer.trace(
        RowRays(zone, point, network.sampling, network.seed), network.point_patches,
        [&](std::size_t patch, std::uint32_t sink) { network.point_sinks.set(point, patch, sink); },
        [](std::size_t, std::size_t) {});
    network.point_back_fraction[point] = static_cast<double>(counts.back) / static_cast<double>(n_patches);
  });
}

void check_size(std::size_t n_cells, const Zone& zone, const NetworkOptions& options, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  const double needed = network_bytes(n_cells, zone.points.size(), options);
  if (needed <= static_cast<double>(job.memory_limit_bytes)) return;
  throw LimitError(fmt::format(
      "the ray network of {} cells x {} patches and {} points x {} patches needs {:.2f} GiB, {:.2f} GiB are "
      "free; use a larger --cell or fewer --patches or --point-patches",
      n_cells, options.patches.n_patches(), zone.points.size(), options.point_patches.n_patches(), needed / kGiB,
      static_cast<double>(job.memory_limit_bytes) / kGiB));
}

// By area: squares that the polygon fills in part make a cell each at least.
std::size_t least_cells(const Zone& zone) {
  double sum = 0.0;
  for (const auto& surface : zone.surfaces) {
    const Vec2 size = surface.polygon.size_m();
    if (!surface.outside)
      sum += n_squares(surface.polygon, surface.cell_m, surface.grid) * surface.polygon.area_m2() / (size.x * size.y);
  }
  return static_cast<std::size_t>(sum);
}

}  // namespace

PatchGrid automatic_point_patches(std::size_t n_points) {
  constexpr std::size_t kRays = 1 << 19;
  for (const int slices : {64, 48, 32, 24}) {
    const PatchGrid patches{slices, 2 * slices};
    if (n_points * patches.n_patches() <= kRays) return patches;
  }
  return {16, 32};
}

double network_bytes(std::size_t n_cells, std::size_t n_points, const NetworkOptions& options) {
  const double rays = static_cast<double>(n_cells) * static_cast<double>(options.patches.n_patches()) +
                      static_cast<double>(n_points) * static_cast<double>(options.point_patches.n_patches());
  constexpr double kPerCell = 200.0;  // geometry, scales and the sums of balancing
  constexpr double kCopies = 2.0;     // the network and the image of its file
  return kCopies * rays * (SinkTable::is_wide(n_cells) ? 4.0 : 2.0) + static_cast<double>(n_cells) * kPerCell;
}

void check_network_fits(const Zone& zone, const NetworkOptions& options, const Job& job) {
  check_size(least_cells(zone), zone, options, job);
}

Network build_network(const Zone& zone, const Cells& cells, const NetworkOptions& options, const Job& job) {
  check_size(cells.size(), zone, options, job);
  Network network;
  network.patches = options.patches;
  network.point_patches = options.point_patches;
  network.sampling = options.sampling;
  network.seed = options.seed;
  network.sinks = SinkTable(cells.size(), options.patches.n_patches(), cells.size());
  network.point_sinks = SinkTable(zone.points.size(), options.point_patches.n_patches(), cells.size());
  const RowTracer tracer(zone, cells);
  trace_cells(network, zone, cells, tracer, job);
  trace_points(network, zone, tracer, job);
  if (options.family) network.extra = find_families(zone, cells, network, job);
  balance(network, cells);
  return network;
}

}  // namespace dim
