#pragma once

#include <cstdint>

#include "base/low_discrepancy.hpp"
#include "network/cells.hpp"
#include "network/network.hpp"

namespace dim {

struct Ray {
  Vec3 from{0.0};
  Vec3 direction{0, 0, 1};  ///< unit
};

/// The rays of one row of a network, from the network's seed: the same ones whenever they are asked for.
class RowRays {
 public:
  /// Rays of a cell.
  RowRays(const Zone& zone, const Cells& cells, std::size_t cell, Sampling sampling, std::uint64_t seed)
      : surface_(&zone.surfaces[cells.surface_of(cell)]),
        cell_(&cells[cell]),
        frame_(surface_->polygon.frame()),
        sampling_(sampling),
        stream_(cell),
        points_(mix(seed) ^ stream_),
        skip_(static_cast<int>(cells.surface_of(cell))) {}

  /// Rays of a measuring point.
  RowRays(const Zone& zone, std::size_t point, Sampling sampling, std::uint64_t seed)
      : frame_(frame_at(zone.points[point])),
        sampling_(sampling),
        stream_(kPointStreams + point),
        points_(mix(seed) ^ stream_) {}

  /// The ray through a patch. @param directions  of the patch's slice
  Ray ray(const PatchGrid& patches, const PatchSlice& directions, int slice, int sector) const {
    const auto patch = static_cast<std::size_t>(slice) * static_cast<std::size_t>(patches.n_sectors) +
                       static_cast<std::size_t>(sector);
    if (sampling_ == Sampling::centre)
      return {cell_ ? frame_.to_world(cell_->centroid) : frame_.origin,
              frame_.direction_to_world(patches.centre(slice, sector))};
    const auto x = points_(patch);
    return {cell_ ? frame_.to_world(point_in_cell(x[2], x[3], stream_ ^ mix(patch))) : frame_.origin,
            frame_.direction_to_world(directions.direction(sector, x[0], x[1]))};
  }

  Ray ray(const PatchGrid& patches, std::size_t patch) const {
    const int slice = static_cast<int>(patch / static_cast<std::size_t>(patches.n_sectors));
    const int sector = static_cast<int>(patch % static_cast<std::size_t>(patches.n_sectors));
    return ray(patches, PatchSlice(patches, slice), slice, sector);
  }

  const Frame& frame() const { return frame_; }
  /// Surface that rays start on and cannot meet, -1 for a point.
  int skip() const { return skip_; }

 private:
  static constexpr std::uint64_t kPointStreams = 1ULL << 40;  // apart from those of the cells

  // The given point of the cell where that is whole, else the first of the stream started there that lies in
  // the clipped region.
  Vec2 point_in_cell(double a, double b, std::uint64_t stream) const {
    Vec2 p = cell_->low + Vec2(a, b) * (cell_->high - cell_->low);
    if (cell_->whole) return p;
    constexpr int kTries = 64;
    const Polygon& polygon = surface_->polygon;
    for (int i = 0; i < kTries && !polygon.contains(p); ++i) {
      stream = mix(stream);
      p = cell_->low + Vec2(unit_from(stream), unit_from(mix(~stream))) * (cell_->high - cell_->low);
    }
    return polygon.contains(p) ? p : cell_->centroid;
  }

  const Surface* surface_ = nullptr;
  const GridCell* cell_ = nullptr;
  Frame frame_;
  Sampling sampling_;
  std::uint64_t stream_;
  LowDiscrepancy4 points_;
  int skip_ = -1;
};

}  // namespace dim
