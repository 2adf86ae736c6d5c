#pragma once

#include <vector>

#include "geometry/ray_caster.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"

namespace dim {

/// A luminaire, or its image in a sequence of mirrors, as a receiver sees it.
///
/// An image is the luminaire reflected in the mirrors' planes one after the other; reflection keeps lengths
/// and angles, so that its intensity in a direction is that of the reflected frame. Light takes the path
/// through all mirrors' polygons, both ends and every leg in between unblocked.
struct Emitter {
  Luminaire luminaire;  ///< in its own place, or where its image is
  const Fitting* fitting = nullptr;
  std::size_t original = 0;  ///< index into Lights::luminaires
  std::vector<int> mirrors;  ///< surfaces, from the light to the receiver; empty: the luminaire itself
};

/// Every luminaire, then the images in up to `depth` of the mirrors given that light can take: the image
/// before each mirror lies in front of it, and mirrors that follow each other face each other.
/// @throws LimitError  more than a million images
std::vector<Emitter> make_emitters(const Zone& zone, const Lights& lights, const std::vector<int>& mirrors,
                                   int depth);

/// The point mirrored in a surface's plane.
Vec3 mirrored(const Zone& zone, int surface, const Vec3& point);

/// Whether the path from `receiver` to `on_image` (a point of the emitter's opening, where the image has it)
/// misses one of the mirrors or is blocked.
/// @param skip  plate the receiver lies on, or -1
bool path_blocked(const Zone& zone, const RayCaster& caster, const Emitter& emitter, const Vec3& receiver,
                  const Vec3& on_image, int skip);

/// Cosines of incidence on the emitter's mirrors, from the receiver's last to the light's first, for the path
/// between two points.
std::vector<double> mirror_cosines(const Zone& zone, const Emitter& emitter, const Vec3& receiver,
                                   const Vec3& on_image);

}  // namespace dim
