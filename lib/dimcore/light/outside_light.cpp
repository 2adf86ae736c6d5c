#include "light/outside_light.hpp"

namespace dim {

OutsideLight::OutsideLight(const Daylight& now, double north_rad, double ground_reflectance)
    : sky_(now.sky),
      north_rad_(north_rad),
      ground_(1),
      ground_cd_m2_(ground_reflectance * now.horizontal_lx() / kPi) {
  if (now.direct_normal_lx > 0.0 && now.sun.z > 0.0)
    sun_ = SunBeam{to_zone(now.sun, north_rad), now.direct_normal_lx};
}

OutsideLight::OutsideLight(const SkyPatches& patches, double north_rad)
    : patches_(patches), north_rad_(north_rad), ground_(patches.size()), ground_cd_m2_(1.0) {}

DaylightPart OutsideLight::part(std::size_t column) const {
  if (column < ground_) return DaylightPart::sky;
  if (column == ground_) return DaylightPart::ground;
  return by_patches() ? DaylightPart::ramp : DaylightPart::sun;
}

}  // namespace dim
