#pragma once

#include <vector>

#include "transport/direct.hpp"
#include "transport/shine.hpp"
#include "transport/shine_state.hpp"

namespace dim {

/// Direct light as columns to gather from: column = class * n_sources + source.
struct DirectColumns {
  std::size_t n_columns = 0;  ///< n_sources where no mirror colours the light (every class alike), else all
  std::vector<double> cell;   ///< [n_cells, n_columns] lx, images in mirrors included
  std::vector<double> point;  ///< [n_points, n_columns]
  std::size_t n_images = 0;   ///< of luminaires in mirrors
  DirectShine shine;          ///< over all n_sources * n_classes columns
};

/// @param source_of  [n_luminaires]
/// @param in_the_way    see `direct_light`
/// @param mirror_depth  mirrors one after the other in which luminaires are imaged
DirectColumns direct_columns(const Zone& zone, const Cells& cells, const Network& network,
                             const Lights& lights, const ReflectanceClasses& classes, const Shine& shine,
                             const Obstructions& obstructions, const std::vector<std::size_t>& source_of,
                             std::size_t n_sources, int mirror_depth, bool in_the_way, const Job& job);

}  // namespace dim
