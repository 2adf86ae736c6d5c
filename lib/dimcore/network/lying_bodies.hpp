#pragma once

#include "network/cells.hpp"

namespace dim {

/// How far from a surface the face of a body, parallel to it, counts as lying on it.
double lies_within_m(const Surface& surface);

/// Leaves of cells only what no luminaire's body lies on (recessed or mounted on their surface, or before it by less
/// than a tenth of a cell): light reaches and leaves that part alone, so that its mean, not that of the half-dark cell, is
/// what the room sees. Cells that are as good as wholly under a body are marked as covered.
/// @param zone        with bodies
/// @param first_body  the surfaces from here on are bodies
void leave_free_of_bodies(Cells& cells, const Zone& zone, std::size_t first_body);

}  // namespace dim
