#include "scene/inside_test.hpp"

namespace dim {
namespace {

std::vector<Plate> bounding_plates(const std::vector<Surface>& surfaces) {
  std::vector<Plate> plates;
  for (const auto& surface : surfaces)
    if (surface.bounding && surface.parent < 0) plates.push_back({&surface.polygon});
  return plates;
}

// Along no axis or diagonal of a building, so that a ray along an edge is the exception.
constexpr Vec3 kDirections[] = {{0.8231, 0.4127, 0.3905},
                                {-0.7413, 0.5347, -0.4056},
                                {0.3178, -0.8861, 0.3375},
                                {-0.2719, -0.3541, -0.8948},
                                {0.1433, 0.2611, 0.9546}};
constexpr int kMost = 3;

}  // namespace

InsideTest::InsideTest(const std::vector<Surface>& surfaces, double diameter_m, bool closed)
    : InsideTest(bounding_plates(surfaces), diameter_m, closed) {}

InsideTest::InsideTest(std::vector<Plate> plates, double diameter_m, bool closed)
    : caster_(std::move(plates), diameter_m), closed_(closed) {}

bool InsideTest::began_outside(const Vec3& point, const Vec3& direction) const {
  const Hit hit = caster_.nearest(point, glm::normalize(direction));
  return hit.plate < 0 ? closed_ : hit.back;
}

bool InsideTest::outside(const Vec3& point) const {
  int n_outside = 0;
  for (const auto& direction : kDirections) n_outside += began_outside(point, direction);
  return n_outside >= kMost;
}

bool InsideTest::outside(const MeasuringPoint& point) const {
  int n_outside = 0;
  for (const auto& direction : kDirections)
    n_outside += began_outside(point.position, glm::dot(direction, point.normal) < 0.0 ? -direction : direction);
  return n_outside >= kMost;
}

}  // namespace dim
