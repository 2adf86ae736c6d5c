#include "light/visible_part.hpp"

#include <algorithm>

#include "geometry/spherical_triangle.hpp"

namespace dim {

void SolidAngleFan::add(const ConvexRing& ring) {
  for (int i = 1; i + 1 < ring.size(); ++i) {
    const Vec3 apex = ring[0] - eye_, from = ring[i] - eye_, to = ring[i + 1] - eye_;
    const double sr = SphericalTriangle(apex, from, to).solid_angle_sr();
    if (!(sr > 0.0)) continue;
    total_sr_ += sr;
    triangles_.push_back({apex, from, to, total_sr_});
  }
}

Vec3 SolidAngleFan::direction(double a, double b) const {
  const double wanted = a * total_sr_;
  auto at = triangles_.begin();
  while (at + 1 != triangles_.end() && at->up_to_sr < wanted) ++at;
  const double before = at == triangles_.begin() ? 0.0 : std::prev(at)->up_to_sr;
  const double share = std::clamp((wanted - before) / (at->up_to_sr - before), 0.0, 1.0);
  // The arc from the apex turns from one corner to the other: one fan is swept without a jump.
  return SphericalTriangle(at->from, at->apex, at->to).direction(share, b);
}

}  // namespace dim
