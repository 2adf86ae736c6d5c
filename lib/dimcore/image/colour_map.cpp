#include "image/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "image/colour_space.hpp"

namespace dim {
namespace {

constexpr int kColours = 256;

// CIE 15:2018 eq. 8.6-8.12, inverse.
Vec3 lab_to_xyz(double lightness, double a, double b) {
  const auto inverse = [](double f) {
    const double edge = 6.0 / 29.0;
    return f > edge ? f * f * f : 3 * edge * edge * (f - 4.0 / 29.0);
  };
  const double fy = (lightness + 16) / 116;
  return xyz_of(kWhiteD65) * Vec3(inverse(fy + a / 500), inverse(fy), inverse(fy - b / 200));
}

Rgb8 make_colour(double t, const glm::dmat3& to_rgb) {
  const double lightness = 14 + 78 * t;
  const double hue_rad = radians(312 - 128 * t - 82 * t * t);
  const double from_middle = t - 0.5;
  // Chroma: least where sRGB is narrowest (teal), more towards both ends.
  const double chroma = 30.5 + (t < 0.5 ? 110 : 150) * from_middle * from_middle;
  const Vec3 rgb = to_rgb * lab_to_xyz(lightness, chroma * std::cos(hue_rad), chroma * std::sin(hue_rad));
  Rgb8 coded{};
  for (int i = 0; i < 3; ++i) {
    coded[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255 * srgb_encode(rgb[i])));
  }
  return coded;
}

std::array<Rgb8, kColours> make_table() {
  std::array<Rgb8, kColours> table{};
  const glm::dmat3 to_rgb = xyz_to_rgb(kSrgbPrimaries);
  for (int i = 0; i < kColours; ++i) {
    table[static_cast<std::size_t>(i)] = make_colour(i / (kColours - 1.0), to_rgb);
  }
  return table;
}

}  // namespace

Rgb8 colour_map(double position) {
  static const std::array<Rgb8, kColours> table = make_table();
  const double clamped = std::clamp(position, 0.0, 1.0);
  return table[static_cast<std::size_t>(std::lround(clamped * (kColours - 1)))];
}

}  // namespace dim
