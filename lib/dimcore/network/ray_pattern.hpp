#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/low_discrepancy.hpp"
#include "geometry/ray.hpp"
#include "network/cell_points.hpp"
#include "network/network.hpp"
#include "network/stream_key.hpp"

namespace dim {

/// The rays of one row of a network, from the network's seed: the same ones whenever they are asked for. Those of a
/// measuring point go where its quantity has them count alike.
class RowRays {
 public:
  /// Rays of a cell.
  RowRays(const Zone& zone, const Cells& cells, std::size_t cell, Sampling sampling, std::uint64_t seed)
      : frame_(zone.surfaces[cells.surface_of(cell)].polygon.frame()),
        sampling_(sampling),
        points_(mix(seed) ^ cell_key(zone, cells, cell)),
        skip_(static_cast<int>(cells.surface_of(cell))) {
    if (sampling == Sampling::centre)
      frame_.origin = frame_.to_world(cells[cell].centroid);
    else
      in_cell_.emplace(zone, cells, cell);
  }

  /// Rays of a measuring point.
  RowRays(const Zone& zone, std::size_t point, Sampling sampling, std::uint64_t seed)
      : frame_(frame_at(zone.points[point])),
        sampling_(sampling),
        points_(mix(seed) ^ point_key(zone, point)),
        quantity_(zone.points[point].quantity) {}

  /// The ray through a patch. @param directions  of the patch's slice
  Ray ray(const PatchGrid& patches, const PatchSlice& directions, int slice, int sector) const {
    if (quantity_ != Quantity::planar) return body_ray(patches, slice, sector);
    if (sampling_ == Sampling::centre)
      return {frame_.origin, frame_.direction_to_world(patches.centre(slice, sector))};
    const auto patch = static_cast<std::size_t>(slice) * static_cast<std::size_t>(patches.n_sectors) +
                       static_cast<std::size_t>(sector);
    const auto x = points_(patch);
    return {in_cell_ ? frame_.to_world((*in_cell_)(x[2], x[3])) : frame_.origin,
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
  // What the patch's weight is the share of is the whole sphere, weighted by the response, in place of the hemisphere.
  Ray body_ray(const PatchGrid& patches, int slice, int sector) const {
    std::array<double, 4> x{};
    if (sampling_ == Sampling::stratified)
      x = points_(static_cast<std::size_t>(slice) * static_cast<std::size_t>(patches.n_sectors) +
                  static_cast<std::size_t>(sector));
    const bool centre = sampling_ == Sampling::centre;
    const double low = static_cast<double>(slice) / patches.n_slices, high = (slice + 1.0) / patches.n_slices;
    const double share = centre ? 0.25 * (low + high) * (low + high) : low * low + x[0] * (high * high - low * low);
    const double turn = (sector + (centre ? 0.5 : x[1])) / patches.n_sectors;
    return {frame_.origin, frame_.direction_to_world(response_direction(quantity_, share, turn))};
  }

  Frame
      frame_;  // of the surface or point; the origin is where all rays start that have no cell to spread over
  Sampling sampling_;
  LowDiscrepancy4 points_;
  std::optional<CellPoints> in_cell_;
  Quantity quantity_ = Quantity::planar;
  int skip_ = -1;
};

}  // namespace dim
