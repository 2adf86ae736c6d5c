#pragma once

#include <optional>
#include <vector>

#include "transport/mirror_outcome.hpp"
#include "transport/plan.hpp"
#include "transport/shine_state.hpp"

namespace dim {

struct MirrorOptions {
  /// What deeper images could still bring is followed by rays (cells) or extrapolated (points) once it is
  /// below this share of a luminaire's light.
  double tolerance = 3e-4;
  std::optional<int> depth;  ///< mirrors one after the other that luminaires are imaged in, instead
};

/// Direct light as columns to gather from: column = class * n_sources + source.
struct DirectColumns {
  std::size_t n_columns = 0;  ///< n_sources where no mirror colours the light (every class alike), else all
  std::vector<double> cell;   ///< [n_cells, n_columns] lx, of luminaires and their images
  std::vector<double> followed;  ///< the same of what rays carried on from the last images; empty without any
  std::vector<double> point;     ///< [n_points, n_columns], deeper images extrapolated
  std::vector<double> point_variance_lx2;  ///< [n_points, n_columns] of what lines past obstacles have found
  std::vector<double> surface_variance_lx2;  ///< [n_surfaces, n_columns] the same of the means of surfaces
  DirectShine shine;             ///< over all n_sources * n_classes columns
  std::vector<float> followed_psi;  ///< as shine.psi, of what rays carried on; empty without any

  MirrorOutcome outcome;
  /// [n_columns] how far images not made can take a measuring point, over the larger of its direct light and
  /// the cells' mean; the largest of all points
  std::vector<double> uncertain;

  /// Lets what rays carried on count as direct light. @returns whether there was any
  bool add_followed();
};

/// Every luminaire is imaged in mirrors, order by order. On cells the images of an order are the last when
/// mirrors reflect less than the tolerance of them, or when they become many; all that mirrors reflect of the
/// last images is followed by rays, so that flux is kept. Points have deeper images, see `point_images`.
///
/// @throws Interrupted
DirectColumns direct_columns(const Room& room, const ModelPlan& plan, const Shine& shine,
                             const MirrorOptions& mirrors, const Job& job);

}  // namespace dim
