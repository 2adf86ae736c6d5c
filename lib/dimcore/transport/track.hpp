#pragma once

#include "transport/gather.hpp"

namespace dim {

struct TrackOptions {
  /// A cell's light is sent on while what it has yet to send exceeds this share of the source's flux.
  double threshold = 1e-6;
};

/// The paper's solver: light-source vectors, what direct light each cell reflects, are taken from a stack,
/// last in first out, and sent down the rays of their cell; where they come down they join what that cell has
/// yet to send, which goes on the stack once it exceeds the threshold. What stays below it in the end is
/// dropped, and reported.
///
/// Shares nothing with `gather` but the network: light is sent along the rows that `gather` collects with,
/// without their balancing scales. Rays carry all they are given, so that energy is kept exactly. Their
/// difference is a sign of the network's own error. Arguments and result as for `gather`; `iterations` counts
/// cells sent in thousands, `residual` is the share of the direct light dropped, `error_bound` that of the mean
/// over cells of what is missing.
/// @throws Interrupted
template <class Real>
Gathered<Real> track(const Zone& zone, const Network& network, const Cells& cells, const Columns<Real>& direct,
                     const Columns<Real>& point_direct, const Reflectances& reflectances,
                     const TrackOptions& options, const Job& job, const GatherShine* shine = nullptr);

}  // namespace dim
