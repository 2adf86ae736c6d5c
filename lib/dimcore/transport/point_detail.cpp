#include "transport/point_detail.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "network/landing.hpp"
#include "network/ray_pattern.hpp"

namespace dim {
namespace {

// A patch is cut where a neighbour differs by more than this share of what patches bring on the average, and its parts
// by the same measure.
constexpr double kContrast = 0.25;
constexpr double kOfTolerance = 0.1;
constexpr int kMostLevels = 8;
// Further rays of a point for one column: four times as many as it has.
constexpr std::size_t kCutsPerPatch = 1;

// A patch cut `level` times in halves both ways; slice and sector count the parts of that level.
struct Part {
  int level = 0;
  std::int32_t slice = 0, sector = 0;

  std::uint64_t key() const {
    return static_cast<std::uint64_t>(level) << 58 | static_cast<std::uint64_t>(slice) << 29 |
           static_cast<std::uint64_t>(sector);
  }
  Part child(int k) const { return {level + 1, 2 * slice + k / 2, 2 * sector + k % 2}; }
  Part above(int at_level) const { return {at_level, slice >> (level - at_level), sector >> (level - at_level)}; }
};

enum class Side { lower, higher, before, after };
constexpr std::array kSides = {Side::lower, Side::higher, Side::before, Side::after};

// Where the parts of a point's patches end, each traced once however many columns ask.
class PointParts {
 public:
  PointParts(const Zone& zone, const Cells& cells, const Network& network, const RayCaster& caster, std::size_t point)
      : zone_(zone),
        cells_(cells),
        sinks_(network.point_sinks),
        grid_(network.point_patches),
        caster_(caster),
        point_(point),
        rays_(zone, point, network.sampling, network.seed),
        stream_(mix(network.seed) ^ point_key(zone, point)) {}

  const PatchGrid& grid() const { return grid_; }

  std::uint32_t sink(const Part& part) {
    if (part.level == 0)
      return sinks_.at(point_, static_cast<std::size_t>(part.slice) * static_cast<std::size_t>(grid_.n_sectors) +
                                   static_cast<std::size_t>(part.sector));
    const auto [entry, is_new] = traced_.try_emplace(part.key(), 0);
    if (is_new) entry->second = trace(part);
    return entry->second;
  }

 private:
  std::uint32_t trace(const Part& part) const {
    const std::uint64_t chance = mix(stream_ ^ mix(part.key()));
    const double scale = 1.0 / static_cast<double>(1 << part.level);
    const Part patch = part.above(0);
    const auto within = [&](std::int32_t at, std::int32_t of, double x) { return scale * (at + x) - of; };
    const Ray ray = rays_.ray(PatchSlice(grid_, patch.slice), patch.sector, within(part.slice, patch.slice, unit_from(chance)),
                              within(part.sector, patch.sector, unit_from(mix(chance))));
    return landing_of(caster_.nearest(ray.from, ray.direction), ray.direction, zone_, cells_).sink;
  }

  const Zone& zone_;
  const Cells& cells_;
  const SinkTable& sinks_;
  const PatchGrid grid_;
  const RayCaster& caster_;
  std::size_t point_;
  RowRays rays_;
  std::uint64_t stream_;
  std::unordered_map<std::uint64_t, std::uint32_t> traced_;
};

// The parts of a point's patches that one column asks for.
class ColumnDetail {
 public:
  // @param exitance  of the column's first cell; the next is `stride` further
  // @param limit     that a part may be wrong by
  ColumnDetail(PointParts& parts, const double* exitance, std::size_t stride, double limit)
      : parts_(parts), grid_(parts.grid()), exitance_(exitance), stride_(stride), limit_(limit) {}

  // Marks what differs from its neighbour for being cut.
  void compare(const Part& a, const Part& b) {
    const double difference = std::abs(value(a) - value(b));
    for (const Part& part : {a, b})
      if (weight(part) * difference > limit_) waiting_.push_back(part);
  }

  void cut_all() {
    const std::size_t most = kCutsPerPatch * grid_.n_patches();
    while (!waiting_.empty() && cut_.size() < most) {
      const Part part = waiting_.front();
      waiting_.pop_front();
      cut(part);
    }
  }

  // What the parts change of all rays' light, and of every other ray's less all.
  double change() const {
    double sum = 0.0;
    for (const Part& patch : patches_cut_) sum += sum_of(patch) - own(patch);
    return sum;
  }
  double change_by_half() const {
    if (grid_.n_sectors % 2 != 0) return 0.0;  // no pairs there, see `half_of_rays`
    double sum = 0.0;
    for (const Part& patch : patches_cut_) {
      const Part other{0, patch.slice, patch.sector ^ 1};
      if (is_cut(other) && other.sector < patch.sector) continue;  // has been counted with it
      const double sign = patch.sector % 2 == 0 ? 1.0 : -1.0;
      sum += pairs_of(patch) + pairs_of(other) - sign * (own(patch) - own(other));
    }
    return sum;
  }

 private:
  double value(const Part& part) const { return exitance_[parts_.sink(part) * stride_]; }
  double weight(const Part& part) const {
    return grid_.weight_sr(part.slice >> part.level) / kPi / static_cast<double>(std::int64_t{1} << (2 * part.level));
  }
  double own(const Part& part) const { return weight(part) * value(part); }
  bool is_cut(const Part& part) const { return cut_.count(part.key()) > 0; }

  void cut(const Part& part) {
    if (part.level == kMostLevels || !cut_.insert(part.key()).second) return;
    if (part.level == 0) patches_cut_.push_back(part);
    for (int k = 0; k < 4; ++k)
      for (const Side side : kSides) compare_with_side(part.child(k), side);
  }

  void compare_with_side(const Part& part, Side side) {
    Part next = part;
    const std::int32_t n_sectors = grid_.n_sectors << part.level, top = (grid_.n_slices << part.level) - 1;
    if (side == Side::lower) {
      if (part.slice == 0) return;
      --next.slice;
    } else if (side == Side::higher && part.slice < top) {
      ++next.slice;
    } else if (side == Side::higher) {
      next.sector = (part.sector + n_sectors / 2) % n_sectors;  // across the pole
    } else {
      next.sector = (part.sector + (side == Side::before ? n_sectors - 1 : 1)) % n_sectors;
    }
    for (int level = 0; level < next.level; ++level) {
      if (!is_cut(next.above(level))) return compare(part, next.above(level));
    }
    compare_with_parts(part, next, side);
  }

  // The parts of `next` that touch the part it lies at the side of.
  void compare_with_parts(const Part& part, const Part& next, Side side) {
    if (!is_cut(next)) return compare(part, next);
    for (int k = 0; k < 4; ++k) {
      const bool across_pole = next.slice == part.slice;
      const bool touches = side == Side::lower    ? k / 2 == 1
                           : side == Side::higher ? k / 2 == (across_pole ? 1 : 0)
                           : side == Side::before ? k % 2 == 1
                                                  : k % 2 == 0;
      if (touches) compare_with_parts(part, next.child(k), side);
    }
  }

  double sum_of(const Part& part) const {
    if (!is_cut(part)) return own(part);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += sum_of(part.child(k));
    return sum;
  }

  // Differences of neighbouring sectors among the finest parts.
  double pairs_of(const Part& part) const {
    if (!is_cut(part)) return 0.0;
    double sum = 0.0;
    for (const int k : {0, 2}) {
      const Part first = part.child(k), second = part.child(k + 1);
      sum += is_cut(first) || is_cut(second) ? pairs_of(first) + pairs_of(second) : own(first) - own(second);
    }
    return sum;
  }

  PointParts& parts_;
  const PatchGrid& grid_;
  const double* exitance_;
  std::size_t stride_;
  double limit_;
  std::deque<Part> waiting_;
  std::unordered_set<std::uint64_t> cut_;
  std::vector<Part> patches_cut_;  // of level 0
};

// Patches whose sinks differ from that of the next sector or of the next slice, across the pole too, with those.
template <class Compare>
void each_border(const SinkTable& sinks, const PatchGrid& grid, std::size_t point, Compare&& compare) {
  for (std::int32_t slice = 0; slice < grid.n_slices; ++slice) {
    for (std::int32_t sector = 0; sector < grid.n_sectors; ++sector) {
      const auto index = [&](std::int32_t i, std::int32_t j) {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(grid.n_sectors) + static_cast<std::size_t>(j);
      };
      const std::uint32_t here = sinks.at(point, index(slice, sector));
      const std::int32_t next = sector + 1 < grid.n_sectors ? sector + 1 : 0;
      const std::uint32_t after = sinks.at(point, index(slice, next));
      if (after != here) compare(Part{0, slice, sector}, here, Part{0, slice, next}, after);
      const bool is_top = slice + 1 == grid.n_slices;
      const Part above = is_top ? Part{0, slice, (sector + grid.n_sectors / 2) % grid.n_sectors} : Part{0, slice + 1, sector};
      const std::uint32_t higher = sinks.at(point, index(above.slice, above.sector));
      if (higher != here) compare(Part{0, slice, sector}, here, above, higher);
    }
  }
}

}  // namespace

PointDetail::Changes PointDetail::changes(const std::vector<double>& exitance, const std::vector<double>& light,
                                          const std::vector<bool>& wanted) const {
  const PatchGrid& grid = network_.point_patches;
  const std::size_t n_points = network_.point_sinks.n_rows(), width = wanted.size();
  const double least = std::max(kContrast / static_cast<double>(grid.n_patches()), kOfTolerance * tolerance_);
  Changes changes{std::vector<double>(n_points * width, 0.0), std::vector<double>(n_points * width, 0.0)};
  if (network_.sampling != Sampling::stratified) return changes;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n_points, 4), [&](const auto& points) {
    std::vector<double> limit(width);
    for (std::size_t p = points.begin(); p != points.end(); ++p) {
      PointParts parts(zone_, cells_, network_, caster_, p);
      std::vector<ColumnDetail> columns;
      for (std::size_t c = 0; c < width; ++c) {
        limit[c] = wanted[c] ? least * light[p * width + c] : std::numeric_limits<double>::infinity();
        columns.emplace_back(parts, &exitance[c], width, limit[c]);
      }
      each_border(network_.point_sinks, grid, p,
                  [&](const Part& a, std::uint32_t at_a, const Part& b, std::uint32_t at_b) {
                    const double weight = grid.weight_sr(std::max(a.slice, b.slice)) / kPi;
                    for (std::size_t c = 0; c < width; ++c) {
                      if (weight * std::abs(exitance[at_a * width + c] - exitance[at_b * width + c]) > limit[c])
                        columns[c].compare(a, b);
                    }
                  });
      for (std::size_t c = 0; c < width; ++c) {
        columns[c].cut_all();
        changes.of_all[p * width + c] = columns[c].change();
        changes.of_half[p * width + c] = columns[c].change_by_half();
      }
    }
  });
  return changes;
}

}  // namespace dim
