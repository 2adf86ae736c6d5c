#pragma once

#include <vector>

#include "scene/lights.hpp"
#include "scene/zone.hpp"

/// Luminaire bodies: what stops and reflects light behind luminous openings.
namespace dim {

/// How far behind its opening a body's front lies: far enough not to hide it from grazing paths by rounding,
/// near enough not to show.
inline constexpr double kBehindOpening_m = 1e-4;

/// Whether a body was asked for and there is one: the opening has an area.
bool has_body(const Luminaire& luminaire);

/// The luminaire's body as surfaces, empty where it has none: front, back, then sides.
///
/// A flat opening gives a two-sided panel of its outline (`twin` counts from the first of them). One with a
/// height gives a closed prism on the outline that reaches behind it by that height; by half of it where the
/// opening is round in the vertical too and the outline its middle section (ellipsoid, horizontal cylinder).
/// Finish and cell size are left to the caller.
std::vector<Surface> body_surfaces(const Luminaire& luminaire);

/// Bodies that differ in place, shape or reflectance: luminaires that share all of them, as the channels of a
/// tunable one do, share one body.
std::size_t count_bodies(const Lights& lights);

/// The zone with the bodies of its luminaires as further surfaces, each with a diffuse finish of the body's
/// reflectance. The order follows the luminaires' places, so that the order of the file does not matter.
/// @param cell_m  of the bodies' surfaces, > 0
Zone with_bodies(const Zone& zone, const Lights& lights, double cell_m);

/// The place of a luminaire with a body, a little in front of the surface that its opening lies on (recessed
/// in a ceiling): so far that the body lies between the two. Its own place where nothing is so near.
Vec3 clear_of_surfaces(const Luminaire& luminaire, const Zone& zone);

}  // namespace dim
