#include "glare/luminous_area.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

double cylinder_m2(double length_m, double diameter_m, double along) {
  return length_m * diameter_m * std::sqrt(std::max(0.0, 1.0 - along * along)) +
         kPi / 4.0 * diameter_m * diameter_m * std::abs(along);
}

}  // namespace

double projected_luminous_area_m2(const LuminousOpening& opening, const Vec3& towards) {
  const double a = opening.length_m, b = opening.width_m, h = opening.height_m;
  const Vec3 d(std::abs(towards.x), std::abs(towards.y), std::abs(towards.z));
  switch (opening.shape) {
    case OpeningShape::kPoint:
    case OpeningShape::kLine:
      return 0.0;
    case OpeningShape::kRectangle:
      return a * b * d.z;
    case OpeningShape::kBox:
      return a * b * d.z + b * h * d.x + a * h * d.y;
    case OpeningShape::kEllipse:
      return kPi / 4.0 * a * b * d.z;
    case OpeningShape::kVerticalCylinder:
      // The width of the ellipse across (dx, dy), times the length of that.
      return kPi / 4.0 * a * b * d.z + h * std::hypot(a * d.y, b * d.x);
    case OpeningShape::kEllipsoid:
      return kPi / 4.0 *
             std::sqrt(std::pow(b * h * d.x, 2) + std::pow(a * h * d.y, 2) + std::pow(a * b * d.z, 2));
    case OpeningShape::kHorizontalCylinder:
      return a >= b ? cylinder_m2(a, b, d.x) : cylinder_m2(b, a, d.y);
    case OpeningShape::kVerticalEllipse:
      return kPi / 4.0 * b * h * d.x;
  }
  return 0.0;
}

}  // namespace dim
