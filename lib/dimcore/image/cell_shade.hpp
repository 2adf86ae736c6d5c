#pragma once

#include "network/cells.hpp"
#include "result/luminous.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Light of a point on a surface, from the values of its cells.
class CellShade {
 public:
  struct Seen {
    double illuminance_lx = 0.0;
    Vec3 xyz_cd_m2{0.0};
  };

  /// @param smooth  bilinear between the middles of neighbouring cells of the same surface; constant from the
  ///                outer middles to the edge. Otherwise the cell's own value.
  CellShade(const Zone& zone, const Cells& cells, CellAppearance appearance, bool smooth)
      : zone_(zone), cells_(cells), appearance_(std::move(appearance)), smooth_(smooth) {}

  /// @param local  in the surface's polygon frame
  Seen at(std::size_t surface, const Vec2& local) const;

 private:
  Seen of_cell(std::size_t cell) const {
    return {appearance_.illuminance_lx[cell], appearance_.xyz_cd_m2[cell]};
  }

  const Zone& zone_;
  const Cells& cells_;
  CellAppearance appearance_;
  bool smooth_;
};

}  // namespace dim
