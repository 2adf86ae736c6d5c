#pragma once

#include "base/vec.hpp"

namespace dim {

/// From the file's coordinates to the zone's: metres, centred.
struct ZoneFrame {
  Vec3 centre{0.0};  ///< in the file's unit
  double unit_m = 1.0;

  // Subtracting first keeps every digit of a zone written far from its origin.
  Vec3 to_zone(const Vec3& p) const { return (p - centre) * unit_m; }
  Vec3 to_file(const Vec3& p_m) const { return p_m / unit_m + centre; }
};

}  // namespace dim
