#pragma once

#include "base/job.hpp"
#include "network/network_storage.hpp"
#include "result/point_error.hpp"
#include "transport/simulate.hpp"

namespace dim {

/// The error of measuring points that 95 % of them do not exceed, relative to their illuminance, and its parts; points
/// that are dark or not valid are left out.
struct StatedShare {
  double total = 0.0;
  double cells = 0.0, rays = 0.0, cell_rays = 0.0, direct = 0.0, bound = 0.0;  ///< each by itself, the same way
};
StatedShare stated_share(const std::vector<PointError>& errors, const std::vector<double>& lx,
                         const std::vector<MeasuringPoint>& points);

/// What a solution to an asked accuracy has come to.
struct ToAccuracy {
  double stated = 0.0;        ///< share of the illuminance, at 95 % of points
  bool reached = false;
  int n_networks = 0;         ///< traced in place of the file's
  double cell_size = 1.0;     ///< over that of the file
  double tolerance = 0.0;     ///< of the iteration
};

/// Refines what limits the points' stated error until it is no more than `share`: the cells' size, rays of cells and of
/// points, the tolerance. All luminaires together are solved for that; the room is then ready to be solved apart.
/// Each part is to become half of the whole, by the power that it falls with: cells' size to 1.6, numbers of rays to 1. Rooms that need more than a billion rays or more memory than there is are left at what was reached.
///
/// @param rays  zone, cells and network, replaced where they are refined
/// @param options  its tolerance is replaced where it is refined
/// @param share  > 0
/// @throws InputError  no measuring point is lit, or the error of this room's light is not known (see `point_errors`)
/// @throws LimitError, Interrupted
ToAccuracy refine_to_accuracy(RaysFile& rays, const Lights& lights, SimulationOptions& options, double share,
                              const Job& job);

}  // namespace dim
