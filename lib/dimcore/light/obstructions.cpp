#include "light/obstructions.hpp"

#include "light/first_flight.hpp"
#include "network/cells.hpp"
#include "scene/luminaire_body.hpp"

namespace dim {
namespace {

std::vector<Surface> bodies_of(const Lights& lights) {
  std::vector<Surface> result;
  for (const auto& luminaire : lights.luminaires) {
    for (auto& surface : body_surfaces(luminaire)) result.push_back(std::move(surface));
  }
  return result;
}

std::vector<Plate> all_plates(const Zone& zone, const std::vector<Surface>& bodies) {
  auto plates = plates_of(zone);
  const auto more = plates_of(bodies);
  plates.insert(plates.end(), more.begin(), more.end());
  return plates;
}

}  // namespace

Obstructions::Obstructions(const Zone& zone, const Lights& lights)
    : bodies_(bodies_of(lights)), caster_(all_plates(zone, bodies_), zone.diameter_m),
      shadows_(all_plates(zone, bodies_), zone.diameter_m) {
  for (const auto& source : own_sources(zone, lights))
    typical_lx_.push_back(typical_illuminance_lx(caster_, source));
}

}  // namespace dim
