#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/area_sampler.hpp"
#include "geometry/ray_caster.hpp"

namespace dim {

/// One of two regions that see each other: the part of a plate that is in front of the other.
struct PairSide {
  int plate = -1;
  const Frame* frame = nullptr;
  const AreaSampler* area = nullptr;
  Vec3 centre{0.0};
  double radius_m = 0.0;  ///< of the sphere round the centre that holds the region
};

/// Share, 0..1, of the light exchanged by two regions, as it would be with nothing between, that arrives.
///
/// Lines start evenly over the area of `from`, which should be the smaller. Where the regions are far apart
/// against the size of `to`, they end evenly over its area, else evenly over the solid angle it covers: the
/// weights then stay within a small range even for regions that share an edge.
///
/// @param n_probe  if the first this many lines are all free, the answer is 1
/// @param n_lines  else this many, >= n_probe
/// @param stream   which sequence of points to use
double visible_share(const RayCaster& caster, const PairSide& from, const PairSide& to, std::uint64_t n_probe,
                     std::uint64_t n_lines, std::uint64_t stream);

}  // namespace dim
