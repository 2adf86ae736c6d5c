#include "network/network.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

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
  template <class Store>
  RowCounts trace(const RowRays& rays, const PatchGrid& patches, Store&& store) const {
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

// Reports progress from whichever thread happens to be free to.
class Meter {
 public:
  Meter(const Job& job, const char* stage, std::size_t total) : job_(job), stage_(stage), total_(total) {}
  void add(std::size_t n) {
    const std::size_t done = done_ += n;
    if (!job_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) job_.report(stage_, static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  const Job& job_;
  const char* stage_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
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
  for_rows(cells.size(), network.patches.n_patches(), "rays", job, [&](std::size_t cell) {
    const RowCounts counts =
        tracer.trace(RowRays(zone, cells, cell, network.sampling, network.seed), network.patches,
                     [&](std::size_t patch, std::uint32_t sink) { network.sinks.set(cell, patch, sink); });
    escaped += counts.escaped;
    back += counts.back;
  });
  network.n_escaped_rays = escaped;
  network.n_back_rays = back;
}

void trace_points(Network& network, const Zone& zone, const RowTracer& tracer, const Job& job) {
  const std::size_t n_patches = network.point_patches.n_patches();
  network.point_back_fraction.resize(zone.points.size());
  for_rows(zone.points.size(), n_patches, "points", job, [&](std::size_t point) {
    const RowCounts counts = tracer.trace(
        RowRays(zone, point, network.sampling, network.seed), network.point_patches,
        [&](std::size_t patch, std::uint32_t sink) { network.point_sinks.set(point, patch, sink); });
    network.point_back_fraction[point] = static_cast<double>(counts.back) / static_cast<double>(n_patches);
  });
}

void check_size(const Cells& cells, const Zone& zone, const NetworkOptions& options, const Job& job) {
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  const std::size_t needed = network_bytes(cells.size(), zone.points.size(), options);
  if (needed <= job.memory_limit_bytes) return;
  throw LimitError(fmt::format(
      "the ray network of {} cells x {} patches and {} points x {} patches needs {:.2f} GiB, {:.2f} GiB are "
      "free; use a larger --cell or fewer --patches or --point-patches",
      cells.size(), options.patches.n_patches(), zone.points.size(), options.point_patches.n_patches(),
      static_cast<double>(needed) / kGiB, static_cast<double>(job.memory_limit_bytes) / kGiB));
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

std::size_t network_bytes(std::size_t n_cells, std::size_t n_points, const NetworkOptions& options) {
  const std::size_t rays =
      n_cells * options.patches.n_patches() + n_points * options.point_patches.n_patches();
  constexpr std::size_t kPerCell = 200;  // geometry, scales and the sums of balancing
  constexpr std::size_t kCopies = 2;     // the network and the image of its file
  return kCopies * rays * (SinkTable::is_wide(n_cells) ? 4 : 2) + n_cells * kPerCell;
}

Network build_network(const Zone& zone, const Cells& cells, const NetworkOptions& options, const Job& job) {
  check_size(cells, zone, options, job);
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
