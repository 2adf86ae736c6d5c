#pragma once

#include <glm/mat4x4.hpp>

#include "base/vec.hpp"

namespace dim {

using Transform = glm::dmat4;

inline Vec3 moved(const Transform& transform, const Vec3& p) { return Vec3(transform * glm::dvec4(p, 1.0)); }

/// Whether it turns right hands into left ones: faces then run the other way round.
inline bool mirrors(const Transform& transform) { return glm::determinant(glm::dmat3(transform)) < 0.0; }

}  // namespace dim
