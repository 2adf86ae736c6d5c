#pragma once

#include "network/network.hpp"

namespace dim {

/// Finds the measuring points that lie where no light of the zone comes: outside it, inside something, or
/// behind its surfaces. Sets `MeasuringPoint::valid`.
///
/// Judged by the point's own rays, some hundreds over the hemisphere that it measures. In a closed zone a
/// point is valid where at least half of them end on lit sides of surfaces (three quarters of those of a point that
/// measures all around); in an open one, where rays may leave, where no more than half meet backs.
void judge_points(const Network& network, Zone& zone);

/// One warning for each plane or sensor list with points that are not valid: how many, and the first places.
Warnings left_out_warnings(const Zone& zone);

}  // namespace dim
