#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "sky/daylight.hpp"
#include "sky/direction.hpp"
#include "sky/sky_patches.hpp"

namespace dim {

/// What a column of daylight is of.
enum class DaylightPart { sky, ground, sun, ramp };

/// A column and the luminance, cd/m2, that it has where something of the outside is seen; column < 0: nothing.
struct OutsideSeen {
  int column = -1;
  double cd_m2 = 0.0;
  int cell = -1;  ///< of an outside surface instead
  int ramp = -1;  ///< column of a ramp that is seen with a patch
  double ramp_cd_m2 = 0.0;

  /// Calls add(column, cd_m2) for every column that is seen.
  template <typename Add>
  void each_column(const Add& add) const {
    if (column >= 0) add(static_cast<std::size_t>(column), cd_m2);
    if (ramp >= 0) add(static_cast<std::size_t>(ramp), ramp_cd_m2);
  }
};

/// The sun as a disc that sends parallel light but for its width.
struct SunBeam {
  Vec3 towards{0, 0, 1};   ///< unit, in the zone's axes
  double normal_lx = 0.0;  ///< illuminance across the beam
};

/// The light of the outside by direction, split into columns that are kept apart: one sky, its ground and its
/// sun; or the columns of SkyPatches at 1 cd/m2 each, for any sky to be mixed from afterwards.
class OutsideLight {
 public:
  /// @param north_rad           true north, clockwise from +y
  /// @param ground_reflectance  of the ground plane, lit by sky and sun
  OutsideLight(const Daylight& now, double north_rad, double ground_reflectance);
  OutsideLight(const SkyPatches& patches, double north_rad);

  /// Columns: sky, ground, and the sun where there is one; or those of the patches.
  std::size_t n_columns() const { return by_patches() ? patches_.n_columns() : ground_ + 1 + (sun_ ? 1 : 0); }
  DaylightPart part(std::size_t column) const;
  bool by_patches() const { return !sky_.has_value(); }
  const SkyPatches& patches() const { return patches_; }

  /// The sky or the ground as seen in a direction of the zone with nothing in the way.
  OutsideSeen open(const Vec3& direction) const {
    if (!(direction.z > 0.0)) return ground();
    const Vec3 in_sky = to_sky(direction, north_rad_);
    if (sky_) return {0, sky_->luminance_cd_m2(in_sky), -1};
    return patch_seen(in_sky);
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
  OutsideSeen patch_seen(const Vec3& in_sky) const {
    const std::size_t patch = patches_.patch_of(in_sky);
    OutsideSeen seen{static_cast<int>(patch), 1.0, -1};
    if (patch == patches_.ground() || patches_.band_of(patch) == patches_.n_ramps()) return seen;
    seen.ramp = static_cast<int>(patches_.ramp(patches_.band_of(patch)));
    seen.ramp_cd_m2 = std::clamp(patches_.ramp_cd_m2(patches_.band_of(patch), in_sky.z), 0.0, 1.0);
    return seen;
  }

  SkyPatches patches_;
  std::optional<Sky> sky_;
  double north_rad_;
  std::size_t ground_;
  double ground_cd_m2_;
  std::optional<SunBeam> sun_;
};

}  // namespace dim
