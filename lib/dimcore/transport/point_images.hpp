#pragma once

#include <optional>
#include <vector>

#include "base/job.hpp"
#include "transport/plan.hpp"

namespace dim {

/// What images of luminaires bring to measuring points.
struct PointImages {
  std::vector<double> lx;  ///< [n_points, n_classes * n_sources], column = class * n_sources + source
  std::vector<double> uncertain_lx;  ///< the same: how far the images not made can take it
  std::vector<int> depth;            ///< [n_luminaires] mirrors one after the other
  std::size_t n = 0;                 ///< images made
};

struct PointImagesOptions {
  double tolerance = 3e-4;   ///< what is uncertain at a point, of its direct light from the same luminaire
  std::optional<int> depth;  ///< mirrors one after the other, and no extrapolation, instead
};

/// Images of each luminaire, order by order, until what deeper ones could still bring is within the tolerance
/// at every point (in every class), the images run out, or become too many; the rest is extrapolated.
///
/// @param direct_lx  [n_points, n_luminaires] from the luminaires themselves
/// @throws Interrupted
PointImages point_images(const Room& room, const ModelPlan& plan, const std::vector<int>& mirrors,
                         const std::vector<double>& direct_lx, const PointImagesOptions& options,
                         const Job& job);

}  // namespace dim
