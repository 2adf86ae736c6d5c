#pragma once

#include <cstdint>
#include <vector>

#include "transport/optics.hpp"
#include "transport/room.hpp"
#include "light/pair_integrator.hpp"

namespace dim {

/// Direct light of one luminaire or image on one cell.
struct CellLight {
  std::size_t cell = 0;
  const PairIntegrator* integrator = nullptr;
  double lx = 0.0;  ///< mean, as if mirrors reflected everything

  const LightSource& source() const { return integrator->source(); }
};

/// Middle of a cell.
Vec3 middle_of(const Room& room, std::size_t cell);

/// Paths along which the light comes, at least one; their `lx` are shares that add up to 1.
/// @param n  paths tried: of those that are blocked or bring nothing the share is 0
std::vector<PairIntegrator::Path> paths_of(const Room& room, const CellLight& light, int n);

/// What the source's mirrors leave of its light at a receiver, by class: 1 without mirrors.
std::vector<double> tints_of(const Zone& zone, const ReflectanceClasses& classes, const LightSource& source,
                             const Vec3& receiver);

}  // namespace dim
