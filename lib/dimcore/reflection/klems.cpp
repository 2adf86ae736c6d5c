#include "reflection/klems.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dim {
namespace klems {
namespace {

// LBNL WINDOW's "LBNL/Klems Full".
constexpr std::array<double, 10> kTheta_deg = {0, 5, 15, 25, 35, 45, 55, 65, 75, 90};
constexpr std::array<std::size_t, 9> kAzimuths = {1, 8, 16, 20, 24, 24, 24, 16, 12};

struct Place {
  std::size_t ring, azimuth;
};

Place place_of(std::size_t patch) {
  std::size_t ring = 0;
  while (patch >= kAzimuths[ring]) patch -= kAzimuths[ring++];
  return {ring, patch};
}

double sine2(std::size_t bound) {
  const double s = std::sin(radians(kTheta_deg[bound]));
  return s * s;
}

}  // namespace

std::size_t patch_of(const Vec3& direction) {
  const double theta_deg = degrees(std::acos(std::clamp(direction.z, 0.0, 1.0)));
  std::size_t ring = 0, first = 0;
  while (ring + 1 < kAzimuths.size() && theta_deg >= kTheta_deg[ring + 1]) first += kAzimuths[ring++];
  const auto n = static_cast<double>(kAzimuths[ring]);
  const double turn = std::atan2(direction.y, direction.x) / (2.0 * kPi);
  const double at = std::floor(0.5 + (turn < 0.0 ? turn + 1.0 : turn) * n);  // patches are centred on azimuth 0
  return first + static_cast<std::size_t>(at) % kAzimuths[ring];
}

double projected_solid_angle_sr(std::size_t patch) {
  const Place place = place_of(patch);
  return kPi * (sine2(place.ring + 1) - sine2(place.ring)) / static_cast<double>(kAzimuths[place.ring]);
}

Vec3 direction(std::size_t patch, double a, double b) {
  const Place place = place_of(patch);
  const double s2 = sine2(place.ring) + a * (sine2(place.ring + 1) - sine2(place.ring));
  const double azimuth = 2.0 * kPi * (static_cast<double>(place.azimuth) + b - 0.5) /
                         static_cast<double>(kAzimuths[place.ring]);
  const double s = std::sqrt(s2);
  return {s * std::cos(azimuth), s * std::sin(azimuth), std::sqrt(1.0 - s2)};
}

}  // namespace klems

double KlemsMatrix::transmittance(std::size_t in) const {
  double sum = 0.0;
  for (std::size_t out = 0; out < klems::kPatches; ++out)
    sum += btdf_per_sr(out, in) * klems::projected_solid_angle_sr(out);
  return sum;
}

double KlemsMatrix::hemispherical_transmittance() const {
  double sum = 0.0;
  for (std::size_t in = 0; in < klems::kPatches; ++in)
    sum += transmittance(in) * klems::projected_solid_angle_sr(in);
  return sum / kPi;
}

}  // namespace dim
