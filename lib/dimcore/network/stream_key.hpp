#pragma once

#include <cmath>
#include <cstdint>

#include "base/low_discrepancy.hpp"
#include "network/cells.hpp"

namespace dim {

/// Names the stream of random numbers of something by where it is and which way it faces, so that neither
/// names nor the order of surfaces, points or luminaires change its rays; nor does the zone's place or scale.
/// Places that agree to 1e-7 of the zone share a stream.
inline std::uint64_t place_key(const Vec3& position, const Vec3& normal, double diameter_m) {
  constexpr double kSteps = 1e7;
  std::uint64_t key = 0;
  for (const Vec3& v : {position / diameter_m, normal}) {
    for (int axis = 0; axis < 3; ++axis)
      key = mix(key ^ static_cast<std::uint64_t>(std::llround(v[axis] * kSteps)));
  }
  return key;
}

inline std::uint64_t cell_key(const Zone& zone, const Cells& cells, std::size_t cell) {
  const Frame& frame = zone.surfaces[cells.surface_of(cell)].polygon.frame();
  return place_key(frame.to_world(cells[cell].centroid), frame.n, zone.diameter_m);
}

/// Apart from that of a cell at the same place.
inline std::uint64_t point_key(const Zone& zone, std::size_t point) {
  const MeasuringPoint& p = zone.points[point];
  return ~place_key(p.position, p.normal, zone.diameter_m);
}

}  // namespace dim
