#pragma once

#include <functional>

#include "base/job.hpp"
#include "network/network_storage.hpp"
#include "result/point_error.hpp"
#include "transport/simulate.hpp"

namespace dim {

/// What a solution to an asked accuracy, or within a time, has come to.
struct ToAccuracy {
  double stated = 0.0;        ///< share of the illuminance, at 95 % of points
  bool reached = false;       ///< the accuracy asked for; within a time: always
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

/// Seconds that all of a solution may take, and a clock that has counted them since it began.
struct TimeBudget {
  double seconds = 0.0;
  std::function<double()> elapsed_s;
};

/// Refines in the same way, halving the stated error or less at a time, as long as the next finer room and the solution
/// after it are expected to end within the budget: by rays, from the seconds that the last round took. Which room that is
/// depends on the machine, so that figures are not the same bits on another one.
/// @throws as refine_to_accuracy
ToAccuracy refine_within(RaysFile& rays, const Lights& lights, SimulationOptions& options, const TimeBudget& budget,
                         const Job& job);

}  // namespace dim
