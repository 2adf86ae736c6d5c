#pragma once

#include <functional>
#include <vector>

#include "base/job.hpp"
#include "geometry/ray_caster.hpp"
#include "network/cells.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"
#include "transport/emitter.hpp"
#include "transport/pair_integrator.hpp"

namespace dim {

/// What stands between lights and receivers: the zone's surfaces, then the bodies of luminaires that have one.
/// `simulate` needs no such bodies: it puts them into the zone (`add_bodies`).
class Obstructions {
 public:
  Obstructions(const Zone& zone, const Lights& lights);
  const RayCaster& caster() const { return caster_; }
  const ShadowPlates& shadows() const { return shadows_; }
  const std::vector<Surface>& bodies() const { return bodies_; }
  /// See `typical_illuminance_lx`.
  double typical_lx(std::size_t luminaire) const { return typical_lx_[luminaire]; }

 private:
  std::vector<Surface> bodies_;
  RayCaster caster_;
  ShadowPlates shadows_;
  std::vector<double> typical_lx_;
};

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

/// Takes the direct illuminance of a cell or point from an emitter, the luminaire's factor included; for one
/// cell or point never from two threads at once, emitters in order.
using DirectSink = std::function<void(std::size_t receiver, std::size_t emitter, const DirectEstimate& direct)>;

/// The same emitter by emitter, images in mirrors included (as if the mirrors reflected everything).
/// @param integrators  of `make_integrators`
/// @throws Interrupted
void direct_light(const Zone& zone, const Cells& cells, const std::vector<Emitter>& emitters,
                  const std::vector<PairIntegrator>& integrators, const DirectSink& on_cell,
                  const DirectSink& on_point, const Job& job);

/// The cell as a receiver of direct light. The result points into `zone`.
Receiver cell_receiver(const Zone& zone, const Cells& cells, std::size_t cell);

/// One integrator an emitter; they point into `zone`, `emitters` and `obstructions`.
/// @param in_the_way  false where no surface can be (see `is_convex_and_empty`): visibility is then not
/// tested
std::vector<PairIntegrator> make_integrators(const Zone& zone, const std::vector<Emitter>& emitters,
                                             const Obstructions& obstructions, bool in_the_way = true);

/// What becomes of a luminaire's light on its first flight, as shares of its flux.
struct FirstFlight {
  double received = 0.0;  ///< on the lit sides of the zone's surfaces
  double escaped = 0.0;   ///< out of the zone, external obstructions included
  double lost = 0.0;      ///< on backs of surfaces and on luminaire bodies
  double flux_lm = 0.0;   ///< of the sampled distribution, times the luminaire's factor
};

/// What illuminance the luminaire brings, its factor left out, where its light falls: the geometric mean over
/// its flux of I/r^2. 0 where none falls on anything.
double typical_illuminance_lx(const RayCaster& caster, const Luminaire& luminaire, const Fitting& fitting);

/// Sends `n_rays` low-discrepancy rays from every luminaire's opening, drawn from its intensity table. Shares no code with `direct_light` but the ray caster, so that the two check each other.
std::vector<FirstFlight> first_flights(const Zone& zone, const Lights& lights, int n_rays, const Job& job);

}  // namespace dim
