#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// What a measuring point measures: the mean illuminance over the surface of a small body that stands there.
enum class Quantity : std::uint8_t {
  planar,           ///< one side of a flat piece
  cylindrical,      ///< the side of a cylinder
  semicylindrical,  ///< the curved side of half an upright cylinder
  hemispherical,    ///< a hemisphere without its base
  scalar            ///< a sphere
};

/// "planar", "cylindrical" …, in the order of Quantity.
const std::vector<std::string>& quantity_words();
inline const std::string& quantity_word(Quantity quantity) {
  return quantity_words()[static_cast<std::size_t>(quantity)];
}

/// How much a measuring point makes of light by its direction: E = integral of weight(direction) L over the whole
/// sphere of solid angles. Each is the share of a thin beam's cross-section that the body catches, over the body's area:
///
///   planar            max(0, d.n)             n: normal
///   cylindrical       |d x n| / pi            n: axis                (2 r h sin(theta) over 2 pi r h)
///   semicylindrical   (|h| + h.n) / pi        n: the level way it faces, h: the level part of d
///   hemispherical     (1 + d.n) / 4           n: axis of the dome    (pi r^2 (1 + cos(theta)) / 2 over 2 pi r^2)
///   scalar            1 / 4
///
/// d is the unit vector towards the light. Under even luminance L from everywhere each gives pi L.
struct Response {
  Vec3 normal{0, 0, 1};  ///< unit
  Quantity quantity = Quantity::planar;

  /// Whether there is light that it leaves out altogether: what comes from behind its plane.
  bool is_planar() const { return quantity == Quantity::planar; }

  /// How far a vector ends from the axis at which the weight has a peak like a cone's, upside down, and no slope to go
  /// by; its length where there is no such axis.
  double off_axis(const Vec3& towards) const {
    if (quantity == Quantity::cylindrical) return glm::length(glm::cross(towards, normal));
    if (quantity == Quantity::semicylindrical) return std::hypot(towards.x, towards.y);
    return glm::length(towards);
  }

  /// The weight of light from a direction times that vector's length, >= 0.
  double of(const Vec3& towards) const {
    const double along = glm::dot(towards, normal);
    if (is_planar()) return along > 0.0 ? along : 0.0;
    return of_body(towards, along);
  }

 private:
  double of_body(const Vec3& towards, double along) const;
};

/// A direction of the frame whose n is the response's normal (for semicylindrical v points up): equal areas of the
/// unit square go to equal parts of the weighted sphere, so that rays at evenly spread (share, turn) count alike.
/// @param share  0..1, how far from where the response is least, or from the foot of the axis up
/// @param turn   0..1 about the normal, or of semicylindrical about the vertical
Vec3 response_direction(Quantity quantity, double share, double turn);

}  // namespace dim
