#include "light/opening_region.hpp"

namespace dim {

OpeningRegion opening_region(const Luminaire& luminaire) {
  const auto& opening = luminaire.opening;
  const bool upright = opening.shape == OpeningShape::kVerticalEllipse;
  OpeningRegion region;
  region.normal = upright ? luminaire.c0 : luminaire.aim;
  const auto corners = outline(opening);
  for (const Vec3& corner : corners) region.ring.add(luminaire.at + luminaire.to_world(corner));
  if (region.ring.empty()) {
    const Vec3 half = 0.5 * (opening.length_m * luminaire.c0 + opening.width_m * luminaire.c90);
    region.ring.add(luminaire.at - half);
    if (opening.shape != OpeningShape::kPoint && half != Vec3(0.0)) region.ring.add(luminaire.at + half);
    if (region.ring.size() == 1) region.ring = ConvexRing(luminaire.at);
  }
  region.measure = region.ring.measure();
  region.bounds = region.ring;
  if (region.ring.size() > 4) {
    // The round outline's first corner lies on one axis, a quarter further on the other.
    const Vec3 a = region.ring[0] - luminaire.at, b = region.ring[kRoundCorners / 4] - luminaire.at;
    region.bounds = ConvexRing();
    for (const Vec3& corner : {-a - b, a - b, a + b, b - a}) region.bounds.add(luminaire.at + corner);
  }
  return region;
}

}  // namespace dim
