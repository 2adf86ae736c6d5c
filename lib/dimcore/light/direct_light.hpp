#pragma once

#include <functional>
#include <vector>

#include "base/job.hpp"
#include "network/cells.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "light/light_source.hpp"
#include "light/obstructions.hpp"
#include "light/pair_integrator.hpp"

namespace dim {

/// Direct illuminance of every cell (area average) and measuring point from every source (a sum of
/// luminaires), visibility included; see `PairIntegrator`. The same bits on any number of threads.
struct DirectLight {
  std::vector<double> cell_lx;   ///< [n_cells, n_sources]
  std::vector<double> point_lx;  ///< [n_points, n_sources]
};

/// @param source_of  [n_luminaires] the source that each luminaire is summed into, < n_sources
/// @throws Interrupted
DirectLight direct_light(const Zone& zone, const Cells& cells, const Lights& lights,
                         const std::vector<std::size_t>& source_of, std::size_t n_sources, const Job& job);

/// Takes the direct illuminance of a cell or point from a source, the luminaire's factor included; for one
/// cell or point never from two threads at once, sources in order.
using DirectSink = std::function<void(std::size_t receiver, std::size_t source, const DirectEstimate& direct)>;

/// The same source by source, images in mirrors included (as if the mirrors reflected everything).
/// @param integrators  of `make_integrators`
/// @throws Interrupted
void direct_light(const Zone& zone, const Cells& cells, const std::vector<PairIntegrator>& integrators,
                  const DirectSink& on_cell, const DirectSink& on_point, const Job& job);

/// The cell as a receiver of direct light. The result points into `zone`.
Receiver cell_receiver(const Zone& zone, const Cells& cells, std::size_t cell);

/// One integrator a source; they point into `zone`, `sources` and `obstructions`.
/// @param options  the typical illuminance is each source's own, whatever is given here
std::vector<PairIntegrator> make_integrators(const Zone& zone, const std::vector<LightSource>& sources,
                                             const Obstructions& obstructions, const PairOptions& options = {});

}  // namespace dim
