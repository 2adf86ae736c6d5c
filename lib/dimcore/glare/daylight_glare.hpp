#pragma once

#include <span>
#include <vector>

#include "glare/position_index.hpp"

namespace dim {

/// What an eye sees in one direction.
struct SeenPixel {
  Vec3 towards{1, 0, 0};  ///< unit, within 90 degrees of the line of sight
  double solid_angle_sr = 0.0;
  double luminance_cd_m2 = 0.0;
};

/// Pixels of an angular fisheye picture of 180 degrees (distance from its middle in proportion to the angle from the
/// line of sight), black; those outside its circle are left out. Their solid angles add up to 2 pi but for what
/// pixels make of the circle's edge.
/// @param side_px  width and height of the picture, at least 1
std::vector<SeenPixel> fisheye_pixels(const LineOfSight& sight, int side_px);

/// Pixels at least as bright as this are glare (evalglare's fixed threshold).
inline constexpr double kGlare_cd_m2 = 2000.0;
/// Glaring pixels no farther apart are one source (evalglare's search radius).
inline constexpr double kOneSource_rad = 0.2;

struct DaylightGlare {
  double vertical_lx = 0.0;  ///< at the eye, from the pixels
  double dgp = 0.0;          ///< daylight glare probability, 0..1
  double dgps = 0.0;         ///< simplified, from the vertical illuminance alone, 0..1
  int n_sources = 0;
};

/// Wienold & Christoffersen 2006:
///   DGP = 5.87e-5 E_v + 0.0918 log10(1 + sum of L^2 omega / (E_v^1.87 P^2)) + 0.16,
/// times exp(0.024 E_v - 4) / (1 + exp(0.024 E_v - 4)) below 1000 lx, as evalglare has it; Wienold 2007:
///   DGPs = 6.22e-5 E_v + 0.184.
/// A source's L is the mean of its pixels by solid angle, its place their mean by light, P Guth's index there
/// (`position_index` without the edge of CIE 117's table), at most 16.
DaylightGlare daylight_glare(std::span<const SeenPixel> pixels, const LineOfSight& sight);

}  // namespace dim
