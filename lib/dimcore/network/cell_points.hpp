#pragma once

#include <algorithm>

#include "geometry/area_sampler.hpp"
#include "network/cells.hpp"

namespace dim {

/// Points spread evenly over what is free of a cell, none thrown away: the map from the unit square is continuous, so that
/// evenly spread numbers give evenly spread points. They keep 2e-9 of the zone's diameter from the cell's
/// edges: a ray that started nearer to a wall than the ray caster tells apart would pass through it.
class CellPoints {
 public:
  CellPoints(const Zone& zone, const Cells& cells, std::size_t cell) : cell_(&cells[cell]) {
    constexpr double kMargin = 2e-9;
    const double margin_m = kMargin * zone.diameter_m;
    const AreaSampler* free = cells.free_part(cell);
    if (cell_->whole && free == nullptr) {
      const Vec2 margin = glm::min(Vec2(margin_m), (cell_->high - cell_->low) / 4.0);
      low_ = cell_->low + margin;
      high_ = cell_->high - margin;
      return;
    }
    Ring2 outline;
    cells.outline(cell, outline);
    double nearest_m = zone.diameter_m;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
      nearest_m = std::min(nearest_m, line_through({outline[j], outline[i]}).height(cell_->centroid));
    inwards_ = nearest_m > 0.0 ? std::min(0.5, margin_m / nearest_m) : 0.5;
    area_ = free ? *free : AreaSampler({outline});
    in_square_ = false;
  }

  /// The point for (a, b) in [0, 1) x [0, 1), in the surface's local frame.
  Vec2 operator()(double a, double b) const {
    if (in_square_) return glm::clamp(cell_->low + Vec2(a, b) * (cell_->high - cell_->low), low_, high_);
    const Vec2 p = area_.point(a, b);
    return p + inwards_ * (cell_->centroid - p);
  }

 private:
  const GridCell* cell_;
  bool in_square_ = true;
  Vec2 low_{0.0}, high_{0.0};
  double inwards_ = 0.0;
  AreaSampler area_;
};

}  // namespace dim
