#pragma once

#include <optional>

#include "base/vec.hpp"

namespace dim {

/// How far from the picture's middle a direction is shown, as a share of the circle's radius.
enum class FisheyeLaw {
  angular,        ///< in proportion to its angle from the view: angle / 90 degrees (equidistant; Radiance's -vta)
  hemispherical,  ///< as the hemisphere looks from above: sin(angle) (orthographic; Radiance's -vth), so that equal
                  ///< areas of the picture bring equal illuminance
};

/// All directions within 90 degrees of a view in the circle that fills a square picture. Picture coordinates as of
/// `Perspective`: pixels, x to the right, y downwards.
class Fisheye {
 public:
  /// @param forward, up  unit, at right angles
  /// @param side_px      width and height of the picture, at least 1
  Fisheye(const Vec3& eye, const Vec3& forward, const Vec3& up, FisheyeLaw law, int side_px);

  const Vec3& eye() const { return eye_; }
  double radius_px() const { return radius_px_; }

  /// Unit direction of the ray through a place in the picture; nothing outside its circle, or on it.
  std::optional<Vec3> direction(double px, double py) const;

  /// What one pixel round a place in the circle sees, sr.
  double solid_angle_sr(double px, double py) const;

  /// Place of a point in the picture; nothing for the eye and what is not before it.
  std::optional<Vec2> project(const Vec3& point) const;

 private:
  Vec3 eye_, forward_, right_, up_;
  FisheyeLaw law_;
  double radius_px_;
};

}  // namespace dim
