#include "transport/direct.hpp"

namespace dim {
namespace {

// "Just behind" the opening: far enough not to hide it from grazing paths by rounding, near enough not to
// show.
constexpr double kBehind_m = 1e-4;

std::vector<Polygon> bodies(const Lights& lights) {
  std::vector<Polygon> result;
  for (const auto& luminaire : lights.luminaires) {
    const Vec3 half_length = luminaire.c0 * (luminaire.opening.length_m / 2.0);
    const Vec3 half_width = luminaire.c90 * (luminaire.opening.width_m / 2.0);
    if (!luminaire.body || half_length == Vec3(0.0) || half_width == Vec3(0.0)) continue;
    const Vec3 centre = luminaire.at - kBehind_m * luminaire.aim;
    result.emplace_back(Ring3{centre - half_length - half_width, centre + half_length - half_width,
                              centre + half_length + half_width, centre - half_length + half_width});
  }
  return result;
}

std::vector<Plate> all_plates(const Zone& zone, const std::vector<Polygon>& panels) {
  auto plates = plates_of(zone);
  for (const auto& panel : panels) plates.push_back({&panel});
  return plates;
}

}  // namespace

Obstructions::Obstructions(const Zone& zone, const Lights& lights)
    : bodies_(bodies(lights)), caster_(all_plates(zone, bodies_), zone.diameter_m),
      shadows_(all_plates(zone, bodies_), zone.diameter_m) {
  for (const auto& luminaire : lights.luminaires)
    typical_lx_.push_back(typical_illuminance_lx(
        caster_, luminaire, lights.fittings[static_cast<std::size_t>(luminaire.fitting)]));
}

}  // namespace dim
