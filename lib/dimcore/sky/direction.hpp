#pragma once

#include "base/vec.hpp"

namespace dim {

/// Directions of the sky stand in a frame of their own: x east, y north, z up. Unit vectors point away from
/// the observer. Azimuths run from north through east, as on a compass.
inline Vec3 sky_direction(double altitude_rad, double azimuth_rad) {
  const double level = std::cos(altitude_rad);
  return {level * std::sin(azimuth_rad), level * std::cos(azimuth_rad), std::sin(altitude_rad)};
}

/// Altitude of a unit vector above the horizon, -pi/2 .. pi/2.
inline double altitude_rad(const Vec3& direction) {
  return std::atan2(direction.z, std::hypot(direction.x, direction.y));
}

/// Azimuth of a unit vector, 0 .. 2 pi; 0 where it is vertical.
inline double azimuth_rad(const Vec3& direction) {
  const double azimuth = std::atan2(direction.x, direction.y);
  return azimuth < 0.0 ? azimuth + 2.0 * kPi : azimuth;
}

/// The same direction in a zone whose +y axis points `north_rad` clockwise of true north (`site.north`).
inline Vec3 to_zone(const Vec3& sky, double north_rad) {
  const double c = std::cos(north_rad), s = std::sin(north_rad);
  return {c * sky.x - s * sky.y, s * sky.x + c * sky.y, sky.z};
}

/// A direction of the zone in the frame of the sky.
inline Vec3 to_sky(const Vec3& zone, double north_rad) { return to_zone(zone, -north_rad); }

}  // namespace dim
