#include "transport/opening_region.hpp"

#include <cmath>

namespace dim {
namespace {

constexpr int kRoundCorners = 32;

bool is_round(OpeningShape shape) {
  return shape == OpeningShape::kEllipse || shape == OpeningShape::kVerticalCylinder ||
         shape == OpeningShape::kEllipsoid || shape == OpeningShape::kVerticalEllipse;
}

}  // namespace

OpeningRegion opening_region(const Luminaire& luminaire) {
  const auto& opening = luminaire.opening;
  const bool upright = opening.shape == OpeningShape::kVerticalEllipse;
  Vec3 a = 0.5 * (upright ? opening.width_m * luminaire.c90 : opening.length_m * luminaire.c0);
  Vec3 b = 0.5 * (upright ? opening.height_m * luminaire.aim : opening.width_m * luminaire.c90);
  if (opening.shape == OpeningShape::kPoint) a = b = Vec3(0.0);
  OpeningRegion region;
  region.normal = upright ? luminaire.c0 : luminaire.aim;
  if (a == Vec3(0.0) && b == Vec3(0.0)) {
    region.ring.add(luminaire.at);
    region.bounds = region.ring;
    return region;
  }
  if (a == Vec3(0.0) || b == Vec3(0.0)) {
    region.ring.add(luminaire.at - a - b);
    region.ring.add(luminaire.at + a + b);
    region.bounds = region.ring;
    region.measure = region.ring.measure();
    return region;
  }
  constexpr double kTurn = 2.0 * kPi / kRoundCorners;
  // Corners a little outside, so that the area is that of the round shape.
  const double swell = is_round(opening.shape) ? std::sqrt(kTurn / std::sin(kTurn)) : 1.0;
  for (const Vec2& side : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    region.bounds.add(luminaire.at + swell * (side.x * a + side.y * b));
  region.ring = region.bounds;
  if (is_round(opening.shape)) {
    region.ring = ConvexRing();
    for (int i = 0; i < kRoundCorners; ++i)
      region.ring.add(luminaire.at + swell * (std::cos(i * kTurn) * a + std::sin(i * kTurn) * b));
  }
  region.measure = region.ring.measure();
  return region;
}

}  // namespace dim
