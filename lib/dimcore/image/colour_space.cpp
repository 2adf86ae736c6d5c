#include "image/colour_space.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "base/error.hpp"

namespace dim {
namespace {

// Share of the largest component beyond which another is outside the gamut, not just rounded there: pixels
// are float.
constexpr double kGamutTolerance = 2e-6;

// Columns, as GLM stores them; XYZ → sharpened cone responses.
const glm::dmat3& bradford_cones() {
  static const glm::dmat3 matrix(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  return matrix;
}

Vec3 cones_of_white(const Vec3& white_xyz) {
  if (white_xyz.y > 0) {
    const Vec3 cones = bradford_cones() * (white_xyz / white_xyz.y);
    if (cones.x > 0 && cones.y > 0 && cones.z > 0) return cones;
  }
  throw InputError({{}, "a white point is not a colour that can be adapted to", "use a white near daylight"});
}

}  // namespace

Vec3 xyz_of(const Chromaticity& c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

Chromaticity chromaticity_of(const Vec3& xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum};
}

glm::dmat3 rgb_to_xyz(const Primaries& primaries) {
  const glm::dmat3 columns(xyz_of(primaries.red), xyz_of(primaries.green), xyz_of(primaries.blue));
  if (!(std::abs(glm::determinant(columns)) > 1e-12)) {
    throw InputError({{}, "the display's primaries lie on one line", "give three different chromaticities"});
  }
  const Vec3 amount = glm::inverse(columns) * xyz_of(primaries.white);
  return {columns[0] * amount.x, columns[1] * amount.y, columns[2] * amount.z};
}

glm::dmat3 xyz_to_rgb(const Primaries& primaries) { return glm::inverse(rgb_to_xyz(primaries)); }

Vec3 luminance_weights(const Primaries& primaries) {
  const glm::dmat3 m = rgb_to_xyz(primaries);
  return {m[0].y, m[1].y, m[2].y};
}

glm::dmat3 bradford_adaptation(const Vec3& from_white_xyz, const Vec3& to_white_xyz) {
  const Vec3 gain = cones_of_white(to_white_xyz) / cones_of_white(from_white_xyz);
  const glm::dmat3 scale(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z);
  return glm::inverse(bradford_cones()) * scale * bradford_cones();
}

Vec3 neutral_white(const Vec3& scene_white_xyz, const Primaries& display) {
  const Vec3 rgb = xyz_to_rgb(display) * scene_white_xyz;
  return rgb.x > 0 && rgb.y > 0 && rgb.z > 0 ? scene_white_xyz : xyz_of(display.white);
}

double srgb_encode(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

double srgb_decode(double coded) {
  const double v = std::clamp(coded, 0.0, 1.0);
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

InGamut bring_into_gamut(const Vec3& rgb, const Vec3& weights, double upper) {
  const auto [low, high] = std::minmax({rgb.x, rgb.y, rgb.z});
  InGamut result{rgb};
  const bool below = low < -kGamutTolerance * std::max(high, 0.0);
  const bool above = high > upper * (1 + kGamutTolerance);
  if (below || above) {
    const double luminance = glm::dot(rgb, weights);
    if (luminance >= upper) {
      result.rgb = Vec3(upper);
      result.above_white = true;
      return result;
    }
    const double grey = std::max(luminance, 0.0);
    double kept = 1.0;
    if (below) kept = std::min(kept, grey / (grey - low));
    if (above) kept = std::min(kept, (upper - grey) / (high - grey));
    result.rgb = Vec3(grey) + kept * (rgb - Vec3(grey));
    result.out_of_gamut = true;
  }
  result.rgb = glm::clamp(result.rgb, 0.0, upper);
  return result;
}

}  // namespace dim
