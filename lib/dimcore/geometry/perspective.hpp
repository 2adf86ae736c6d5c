#pragma once

#include <optional>
#include <utility>

#include "base/vec.hpp"

namespace dim {

/// Where a picture is taken from.
struct Camera {
  Vec3 eye{0.0};
  Vec3 focus{1, 0, 0};   ///< lies in the middle of the picture; not the eye
  Vec3 up{0, 0, 1};      ///< not zero; where it runs along the view, +y (else +x) is up, as on a plan
  double fov_rad = 1.2;  ///< horizontal, between 0 and pi
  int width = 1280;      ///< pixels, square
  int height = 960;
  /// Width of what the picture shows, m, in parallel projection, to scale; 0: perspective.
  double parallel_m = 0.0;
};

/// The top of a picture: across the view, in the plane of view and `up`; where these run along each other, +y (else +x)
/// stands in for up.
/// @param forward  unit
/// @returns unit
Vec3 upright(const Vec3& forward, const Vec3& up);

/// Three-point perspective of a camera, or its parallel projection along the view: a plan, an elevation. Of the
/// latter the eye is where the picture begins: what lies behind it is not shown. Picture coordinates in pixels, x to the right, y downwards from the
/// picture's upper left corner; pixel (i, j) has its middle at (i + 0.5, j + 0.5).
class Perspective {
 public:
  /// @throws InternalError for a camera outside the ranges given there: callers check input first
  explicit Perspective(const Camera& camera);

  const Vec3& eye() const { return eye_; }
  /// Where the ray through a place in the picture starts: the eye, in parallel projection beside it.
  Vec3 origin(double px, double py) const;
  /// Where the line of sight to a point starts.
  Vec3 origin_towards(const Vec3& point) const {
    return parallel_ ? point - depth_m(point) * forward_ : eye_;
  }
  bool parallel() const { return parallel_; }
  /// Whether the side of a plane that its normal points to is seen.
  bool faces(const Vec3& point, const Vec3& normal) const {
    return glm::dot(parallel_ ? -forward_ : eye_ - point, normal) > 0.0;
  }
  const Vec3& forward() const { return forward_; }  ///< unit
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Unit direction of the ray through a place in the picture.
  Vec3 direction(double px, double py) const;

  /// Distance of a point in front of the eye along the view, negative behind.
  double depth_m(const Vec3& point) const { return glm::dot(point - eye_, forward_); }

  /// Place of a point in the picture, inside it or not; nothing for a point nearer than `near_m` along the
  /// view.
  std::optional<Vec2> project(const Vec3& point, double near_m = 0.0) const;

  /// The part of the segment that is in the picture and no nearer than `near_m`, as its start and end in
  /// units of b - a; nothing where none is.
  std::optional<std::pair<double, double>> clip(const Vec3& a, const Vec3& b, double near_m) const;

 private:
  Vec2 at_depth(const Vec3& point, double depth_m) const;

  Vec3 eye_, forward_, right_, up_;
  double focal_px_ = 0.0;  // distance of the picture plane; in parallel projection pixels per metre
  bool parallel_ = false;
  int width_ = 0, height_ = 0;
};

}  // namespace dim
