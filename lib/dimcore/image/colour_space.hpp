#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>

#include "base/vec.hpp"

/// Colour spaces of displays and picture files: primaries, white points, transfer function.
namespace dim {

/// CIE 1931 chromaticity coordinates, y > 0.
struct Chromaticity {
  double x = 0;
  double y = 0;
};

/// An additive colour space: its three primaries and the white that R = G = B = 1 makes.
struct Primaries {
  Chromaticity red, green, blue, white;
};

inline constexpr Chromaticity kWhiteD65 = {0.3127, 0.3290};
inline constexpr Chromaticity kWhiteEqualEnergy = {1.0 / 3.0, 1.0 / 3.0};

/// IEC 61966-2-1 (sRGB) and ITU-R BT.709.
inline constexpr Primaries kSrgbPrimaries = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kWhiteD65};
/// Those that Radiance assumes for a picture that names none: equal-energy white.
inline constexpr Primaries kRadiancePrimaries = {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, kWhiteEqualEnergy};

/// XYZ of a chromaticity at luminance Y = 1.
Vec3 xyz_of(const Chromaticity& chromaticity);

/// Chromaticity of a colour with X + Y + Z > 0.
Chromaticity chromaticity_of(const Vec3& xyz);

/// Linear RGB → XYZ with Y = 1 at R = G = B = 1 (SMPTE RP 177). Its second row holds the luminance weights.
/// @throws InputError  the primaries lie on one line
glm::dmat3 rgb_to_xyz(const Primaries& primaries);

/// Inverse of rgb_to_xyz.
glm::dmat3 xyz_to_rgb(const Primaries& primaries);

/// Chromatic adaptation of XYZ from one white to another: von Kries scaling in the Bradford cone space
/// (Lam 1985, matrix as in ICC.1:2022 annex E). Both whites are scaled to Y = 1 first, so that greys keep
/// their luminance.
/// @throws InputError  a white has Y <= 0 or a cone response <= 0
glm::dmat3 bradford_adaptation(const Vec3& from_white_xyz, const Vec3& to_white_xyz);

/// The white to adapt to: the scene's, where the display can show its colour (all three components above 0),
/// else the display's own, so that the light keeps its colour. Light of nearly one wavelength, a sodium
/// lamp's or a red LED's, does not come to look white, and has no place among the cone responses of a white.
/// @param scene_white_xyz  any scale
Vec3 neutral_white(const Vec3& scene_white_xyz, const Primaries& display);

/// Transfer function of IEC 61966-2-1: linear 0..1 → coded 0..1. Values outside are clamped.
double srgb_encode(double linear);

/// Inverse of srgb_encode.
double srgb_decode(double coded);

/// A linear RGB brought into the unit cube.
struct InGamut {
  Vec3 rgb;
  bool above_white = false;   ///< luminance >= 1 and something had to give: became white
  bool out_of_gamut = false;  ///< a component was below 0, or above 1 at a luminance below 1
};

/// Brings a colour into 0..1 along the line to the grey of its own luminance, so that luminance and dominant
/// wavelength stay. Luminances above 1 become white.
/// @param luminance_weights  second row of rgb_to_xyz, sum 1
/// @param upper              1 for a display; infinity where only negative components are at fault
InGamut bring_into_gamut(const Vec3& rgb, const Vec3& luminance_weights, double upper = 1.0);

/// Second row of rgb_to_xyz.
Vec3 luminance_weights(const Primaries& primaries);

}  // namespace dim
