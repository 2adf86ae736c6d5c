#include "scene/inside_test.hpp"

namespace dim {
namespace {

std::vector<Plate> bounding_plates(const std::vector<Surface>& surfaces) {
  std::vector<Plate> plates;
  for (const auto& surface : surfaces)
    if (surface.bounding && surface.parent < 0) plates.push_back({&surface.polygon});
  return plates;
}

}  // namespace

InsideTest::InsideTest(const std::vector<Surface>& surfaces, double diameter_m, bool closed)
    : caster_(bounding_plates(surfaces), diameter_m), closed_(closed) {}

bool InsideTest::outside(const Vec3& point) const {
  // Along no axis or diagonal of a building, so that a ray along an edge is the exception.
  static const Vec3 kDirections[] = {{0.8231, 0.4127, 0.3905},
                                     {-0.7413, 0.5347, -0.4056},
                                     {0.3178, -0.8861, 0.3375},
                                     {-0.2719, -0.3541, -0.8948},
                                     {0.1433, 0.2611, 0.9546}};
  int n_outside = 0;
  for (const auto& direction : kDirections) {
    const Hit hit = caster_.nearest(point, glm::normalize(direction));
    n_outside += hit.plate < 0 ? closed_ : hit.back;
  }
  return n_outside >= 3;
}

}  // namespace dim
