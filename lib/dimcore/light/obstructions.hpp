#pragma once

#include <vector>

#include "geometry/ray_caster.hpp"
#include "geometry/shadow_plates.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"

namespace dim {

/// What stands between lights and receivers: the zone's surfaces, then the bodies of luminaires that have one.
/// `simulate` needs no such bodies: it puts them into the zone (`add_bodies`).
class Obstructions {
 public:
  Obstructions(const Zone& zone, const Lights& lights);
  Obstructions(const Obstructions&) = delete;
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

}  // namespace dim
