#pragma once

#include <cstdint>
#include <vector>

#include "network/cells.hpp"
#include "transport/emitter.hpp"
#include "transport/optics.hpp"
#include "transport/pair_integrator.hpp"

namespace dim {

/// Direct light of one emitter on one cell.
struct CellLight {
  std::size_t cell = 0;
  const Emitter* emitter = nullptr;
  const PairIntegrator* integrator = nullptr;
  double lx = 0.0;  ///< mean, as if mirrors reflected everything
};

/// Middle of a cell.
Vec3 middle_of(const Zone& zone, const Cells& cells, std::size_t cell);

/// A stream of chance that belongs to an emitter's place and to nothing else.
std::uint64_t stream_of(const Emitter& emitter);

/// Paths along which the light comes, at least one; their `lx` are shares that add up to 1.
/// @param n  paths tried: of those that are blocked or bring nothing the share is 0
std::vector<PairIntegrator::Path> paths_of(const Zone& zone, const Cells& cells, const CellLight& light,
                                           int n);

/// What the emitter's mirrors leave of its light at a receiver, by class: 1 without mirrors.
std::vector<double> tints_of(const Zone& zone, const ReflectanceClasses& classes, const Emitter& emitter,
                             const Vec3& receiver);

}  // namespace dim
