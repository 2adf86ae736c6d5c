#pragma once

#include <optional>
#include <vector>

#include "sky/daylight.hpp"
#include "sky/direction.hpp"
#include "sky/sky_patches.hpp"

namespace dim {

/// What a column of daylight is of.
enum class DaylightPart { sky, ground, sun };

/// A column and the luminance, cd/m2, that it has where something of the outside is seen; column < 0: nothing.
struct OutsideSeen {
  int column = -1;
  double cd_m2 = 0.0;
  int cell = -1;  ///< of an outside surface instead
};

/// The sun as a disc that sends parallel light but for its width.
struct SunBeam {
  Vec3 towards{0, 0, 1};   ///< unit, in the zone's axes
  double normal_lx = 0.0;  ///< illuminance across the beam
};

/// The light of the outside by direction, split into columns that are kept apart: one sky, its ground and its
/// sun; or every patch of the sky and the ground at 1 cd/m2 each, for any sky to be mixed from afterwards.
class OutsideLight {
 public:
  /// @param north_rad           true north, clockwise from +y
  /// @param ground_reflectance  of the ground plane, lit by sky and sun
  OutsideLight(const Daylight& now, double north_rad, double ground_reflectance);
  OutsideLight(const SkyPatches& patches, double north_rad);

  /// Columns: sky (or all patches), ground, and the sun where there is one.
  std::size_t n_columns() const { return ground_ + 1 + (sun_ ? 1 : 0); }
  DaylightPart part(std::size_t column) const;
  bool by_patches() const { return !sky_.has_value(); }
  const SkyPatches& patches() const { return patches_; }

  /// The sky or the ground as seen in a direction of the zone with nothing in the way.
  OutsideSeen open(const Vec3& direction) const {
    if (!(direction.z > 0.0)) return ground();
    const Vec3 in_sky = to_sky(direction, north_rad_);
    if (sky_) return {0, sky_->luminance_cd_m2(in_sky), -1};
    return {static_cast<int>(patches_.patch_of(in_sky)), 1.0, -1};
  }
  OutsideSeen ground() const { return {static_cast<int>(ground_), ground_cd_m2_, -1}; }

  const std::optional<SunBeam>& sun() const { return sun_; }
  std::size_t sun_column() const { return ground_ + 1; }

  /// Directions of the zone, spread over a patch of the vault (what luminance is made of is constant or smooth in
  /// each) or over the ground. @param s, t  in [0, 1)
  Vec3 direction(std::size_t patch, double s, double t) const {
    return to_zone(patches_.direction(patch, s, t), north_rad_);
  }

 private:
  SkyPatches patches_;
  std::optional<Sky> sky_;
  double north_rad_;
  std::size_t ground_;
  double ground_cd_m2_;
  std::optional<SunBeam> sun_;
};

}  // namespace dim
