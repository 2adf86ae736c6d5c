#pragma once

#include "transport/mirror_rays.hpp"

namespace dim {

/// Memory that shine takes at most, told before anything of it is made. Bytes.
struct ShineMemory {
  std::size_t links = 0;  ///< lobes' and mirrors' links while they are made, and their scales
  std::size_t light = 0;  ///< light by direction: direct, while it is solved, solved, and as it is stored
  std::size_t n_off_specular = 0, n_patches = 0;
  std::size_t total() const { return links + light; }
};

/// Links of mirrors are counted on a sample of rows: what a ray meets further on is not known before.
///
/// @param caster     of everything in the way
/// @param n_columns  sources * classes
ShineMemory shine_memory(const Zone& zone, const Cells& cells, const Network& network,
                         const ReflectanceClasses& classes, const RayCaster& caster,
                         const MirrorRayOptions& mirror_rays, std::size_t n_columns);

}  // namespace dim
