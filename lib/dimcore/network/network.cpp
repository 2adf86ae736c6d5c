#include "network/network.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

#include "base/low_discrepancy.hpp"
#include "network/balance.hpp"
#include "network/family.hpp"

namespace dim {
namespace {

constexpr std::size_t kRaysPerBlock = 16384;

// Where a row's rays start and how its hemisphere stands.
struct RowOrigin {
  const Frame* frame;
  const GridCell* cell;  // null: a measuring point, all rays start at the frame's origin
  const Polygon* polygon;
  int skip;
};

// A point of the cell for each ray: the given one where the cell is whole, else the first of the stream
// started there that lies in the clipped region.
Vec2 point_in_cell(const GridCell& cell, const Polygon& polygon, double a, double b, std::uint64_t stream) {
  Vec2 p = cell.low + Vec2(a, b) * (cell.high - cell.low);
  if (cell.whole) return p;
  constexpr int kTries = 64;
  for (int i = 0; i < kTries && !polygon.contains(p); ++i) {
    stream = mix(stream);
    p = cell.low + Vec2(unit_from(stream), unit_from(mix(~stream))) * (cell.high - cell.low);
  }
  return polygon.contains(p) ? p : cell.centroid;
}

struct RowCounts {
  std::uint64_t escaped = 0;
  std::uint64_t back = 0;
};

class RowTracer {
 public:
  RowTracer(const Zone& zone, const Cells& cells, Sampling sampling, std::uint64_t seed)
      : zone_(zone),
        cells_(cells),
        caster_(plates_of(zone), zone.diameter_m),
        sampling_(sampling),
        seed_(seed) {}

  // Traces all rays of one row and hands each (patch, sink) to `store`.
  template <class Store>
  RowCounts trace(const RowOrigin& origin, const PatchGrid& patches, std::uint64_t stream,
                  Store&& store) const {
    RowCounts counts;
    const LowDiscrepancy4 points(mix(seed_) ^ stream);
    std::size_t patch = 0;
    for (int slice = 0; slice < patches.n_slices; ++slice) {
      const PatchSlice directions(patches, slice);
      for (int sector = 0; sector < patches.n_sectors; ++sector, ++patch) {
        Vec3 from = origin.frame->origin;
        Vec3 direction;
        if (sampling_ == Sampling::centre) {
          if (origin.cell) from = origin.frame->to_world(origin.cell->centroid);
          direction = patches.centre(slice, sector);
        } else {
          const auto x = points(patch);
          direction = directions.direction(sector, x[0], x[1]);
          if (origin.cell)
            from = origin.frame->to_world(
                point_in_cell(*origin.cell, *origin.polygon, x[2], x[3], stream ^ mix(patch)));
        }
        const Hit hit = caster_.nearest(from, origin.frame->direction_to_world(direction), origin.skip);
        store(patch, sink_of(hit, counts));
      }
    }
    return counts;
  }

 private:
  std::uint32_t sink_of(const Hit& hit, RowCounts& counts) const {
    const auto nothing = static_cast<std::uint32_t>(cells_.size());
    if (hit.plate < 0) {
      ++counts.escaped;
      return nothing;
    }
    const auto surface = static_cast<std::size_t>(hit.plate);
    if (hit.back || zone_.surfaces[surface].outside) {
      ++(hit.back ? counts.back : counts.escaped);
      return nothing;
    }
    return static_cast<std::uint32_t>(cells_.first(surface)) +
           static_cast<std::uint32_t>(cells_.grid(surface).cell_at(hit.local));
  }

  const Zone& zone_;
  const Cells& cells_;
  RayCaster caster_;
  Sampling sampling_;
  std::uint64_t seed_;
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
    const std::size_t surface = cells.surface_of(cell);
    const auto& polygon = zone.surfaces[surface].polygon;
    const RowOrigin origin{&polygon.frame(), &cells[cell], &polygon, static_cast<int>(surface)};
    const RowCounts counts =
        tracer.trace(origin, network.patches, cell,
                     [&](std::size_t patch, std::uint32_t sink) { network.sinks.set(cell, patch, sink); });
    escaped += counts.escaped;
    back += counts.back;
  });
  network.n_escaped_rays = escaped;
  network.n_back_rays = back;
}

void trace_points(Network& network, const Zone& zone, const RowTracer& tracer, const Job& job) {
  constexpr std::uint64_t kPointStreams = 1ULL << 40;  // apart from those of the cells
  const std::size_t n_patches = network.point_patches.n_patches();
  network.point_back_fraction.resize(zone.points.size());
  for_rows(zone.points.size(), n_patches, "points", job, [&](std::size_t point) {
    const Frame frame = frame_at(zone.points[point]);
    const RowCounts counts = tracer.trace(
        {&frame, nullptr, nullptr, -1}, network.point_patches, kPointStreams + point,
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
  const RowTracer tracer(zone, cells, options.sampling, options.seed);
  trace_cells(network, zone, cells, tracer, job);
  trace_points(network, zone, tracer, job);
  if (options.family) network.extra = find_families(zone, cells, network, job);
  balance(network, cells);
  return network;
}

}  // namespace dim
