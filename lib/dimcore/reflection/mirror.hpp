#pragma once

#include <algorithm>
#include <span>

#include "base/vec.hpp"
#include "reflection/specular.hpp"

namespace dim {

/// The direction that a plane mirror with the unit normal `normal` gives to light, or a line of sight,
/// travelling along the unit vector `direction`; either way round.
inline Vec3 mirror_direction(const Vec3& normal, const Vec3& direction) {
  return glm::normalize(direction - 2.0 * glm::dot(direction, normal) * normal);
}

/// Cosine of incidence of a line that travels along the unit vector `direction` to a mirror's lit side, 0..1.
inline double mirror_cosine(const Vec3& normal, const Vec3& direction) {
  return std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
}

/// Lets a line go on at a plane mirror: `direction` turns, and what is left of its light in each class (or
/// band) k is multiplied by the mirror's k_s F there. Mirrors are met one after the other, each at the
/// direction that the one before gave; light's way is reversible, so that this holds from either end.
///
/// @param normal         unit, of the lit side
/// @param direction      unit, towards the mirror; turned
/// @param tint           [n_classes] 0..1, multiplied
/// @param reflection_of  k -> const BandReflection&
/// @returns the largest tint left
template <class ReflectionOf>
double meet_mirror(const Vec3& normal, Vec3& direction, std::span<double> tint,
                   ReflectionOf&& reflection_of) {
  const double cosine = mirror_cosine(normal, direction);
  double largest = 0.0;
  for (std::size_t k = 0; k < tint.size(); ++k) {
    tint[k] *= reflection_of(k).fresnel(cosine);
    largest = std::max(largest, tint[k]);
  }
  direction = mirror_direction(normal, direction);
  return largest;
}

}  // namespace dim
