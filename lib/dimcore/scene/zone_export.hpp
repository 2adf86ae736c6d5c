#pragma once

#include <string>

#include "scene/zone.hpp"

/// A zone for other programs: metres, the user's coordinates, every surface as polygons without holes that
/// face the way they are lit from, coordinates to 17 digits. Colours become luminous reflectances and
/// transmittances under equal energy. What the other format cannot say is added to `warnings`, once a finish.
namespace dim {

/// Radiance scene: a `plastic`, `mirror` or `glass` for each finish, then a `polygon` for each ring. The
/// diffuse and the specular part of an opaque finish (at normal incidence) are those of the zone; `glass`
/// has the transmissivity that gives the normal transmittance (Radiance's formula for index 1.52).
/// A panel of two sides of one finish is written once, as Radiance's surfaces have two sides.
std::string to_radiance(const Zone& zone, std::vector<Problem>& warnings);

/// Wavefront OBJ: a group for each surface, `usemtl` its finish.
std::string to_obj(const Zone& zone);

/// Measuring points as `rtrace` reads them: x y z and the normal, a line each, in the zone's order.
std::string to_sensor_points(const Zone& zone);

}  // namespace dim
