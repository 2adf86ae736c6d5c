#pragma once

#include <vector>

#include "base/vec.hpp"

namespace dim {

/// The shapes of luminous openings that LM-63 can state (LM-63-2002 and 2019, table of luminous openings).
enum class OpeningShape {
  kPoint,
  kLine,                ///< one horizontal dimension only
  kRectangle,           ///< length x width
  kBox,                 ///< rectangle with luminous sides of the given height
  kEllipse,             ///< a disc where length = width
  kVerticalCylinder,    ///< ellipse with luminous sides
  kEllipsoid,           ///< a sphere where all three are equal
  kHorizontalCylinder,  ///< axis along the longer of length and width
  kVerticalEllipse      ///< in the plane of C90-C270 and the vertical, facing C0: width x height
};

/// Luminous opening of a luminaire, centred at its photometric centre.
struct LuminousOpening {
  OpeningShape shape = OpeningShape::kPoint;
  double length_m = 0.0;  ///< along C0-C180, >= 0
  double width_m = 0.0;   ///< along C90-C270, >= 0
  double height_m = 0.0;  ///< along the aim, >= 0
};

/// Opening from the three dimensions of an LM-63 file, their signs being the code for the shape.
///
/// Up to LM-63-1995 a round opening is (-d, 0, 0), a sphere (-d, 0, -d), a horizontal cylinder (0, l, -d) or
/// (w, 0, -d), an ellipse or ellipsoid (-w, l, .) or (w, -l, .); from LM-63-2002 on every round dimension is
/// negative: disc (-d, -d, 0), cylinder (-d, -d, h), sphere (-d, -d, -d), horizontal cylinder (-d, l, -d) or
/// (w, -d, -d), vertical ellipse (-w, 0, -h). Both are accepted whatever the year; the year decides only
/// (-, 0, -) and (-, l, -), which changed meaning.
///
/// @param width_m, length_m, height_m  as in the file, signed, already in metres
/// @param format_year                  1986, 1991, 1995, 2002 or 2019
LuminousOpening opening_from_lm63(double width_m, double length_m, double height_m, int format_year);

/// The point of the opening that belongs to a point of the unit square, in the luminaire's frame (x = C0,
/// y = C90, z = aim), metres. Equal areas of the square go to equal areas of the opening (concentric map for
/// the round ones, Shirley & Chiu 1997).
///
/// Everything but a vertical ellipse is represented by its horizontal section through the centre (z = 0): a
/// box by its rectangle, a vertical cylinder and an ellipsoid by their ellipse, a horizontal cylinder by its
/// rectangle of length x diameter.
///
/// @param unit  within [0, 1) x [0, 1)
Vec3 sample(const LuminousOpening& opening, const Vec2& unit);

/// The middles of n_length x n_width equal-area parts of the opening, in the luminaire's frame, metres.
/// @param n_length, n_width  at least 1; a point has one sample, a line as many as the larger of the two
std::vector<Vec3> sample_grid(const LuminousOpening& opening, int n_length, int n_width);

/// Corners of a round opening's outline.
inline constexpr int kRoundCorners = 32;

/// Outline of what `sample` covers, in the luminaire's frame, metres; round shapes as a polygon of equal area.
/// Seen in space from behind the opening (from -aim, of a vertical ellipse from C180) it runs
/// counter-clockwise. Empty where the area is zero.
std::vector<Vec3> outline(const LuminousOpening& opening);

/// Area that `sample` covers, m2; zero for a point and a line.
double area_m2(const LuminousOpening& opening);

/// Longest side or diameter of what `sample` covers, m.
double largest_dimension_m(const LuminousOpening& opening);

}  // namespace dim
