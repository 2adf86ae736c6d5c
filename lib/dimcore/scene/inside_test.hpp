#pragma once

#include <memory>
#include <vector>

#include "geometry/ray_caster.hpp"
#include "scene/zone.hpp"

namespace dim {

/// Tells which side of the zone's bounding surfaces a point lies on, by what rays from it meet first: a face
/// from its front inside the zone, from behind outside it (or inside furniture written as surfaces).
class InsideTest {
 public:
  /// @param surfaces  parents still whole; must outlive the test. Only bounding ones are looked at.
  /// @param closed    the bounding surfaces leave no gap: a ray that meets nothing began outside
  InsideTest(const std::vector<Surface>& surfaces, double diameter_m, bool closed);

  /// With any surfaces: who stands inside a box sees its faces from behind as well.
  InsideTest(std::vector<Plate> plates, double diameter_m, bool closed);

  /// Whether the point lies outside for certain: most of five rays say so. Points on a face are not outside.
  bool outside(const Vec3& point) const;

  /// The same by what lies before a receiver alone, which may lie on a face.
  bool outside(const MeasuringPoint& point) const;

 private:
  bool began_outside(const Vec3& point, const Vec3& direction) const;

  RayCaster caster_;
  bool closed_ = false;
};

}  // namespace dim
