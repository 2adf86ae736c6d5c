#include "photometry/opening.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

enum class Sign { kMinus, kZero, kPlus };

// Dimensions below a micrometre are written by programs that mean zero.
constexpr double kZeroDimension_m = 1e-6;

Sign sign_of(double dimension_m) {
  if (std::abs(dimension_m) < kZeroDimension_m) return Sign::kZero;
  return dimension_m < 0.0 ? Sign::kMinus : Sign::kPlus;
}

bool round_shape(OpeningShape shape) {
  return shape == OpeningShape::kEllipse || shape == OpeningShape::kVerticalCylinder ||
         shape == OpeningShape::kEllipsoid || shape == OpeningShape::kVerticalEllipse;
}

/// Shape of a flat or upright opening: height zero or positive.
OpeningShape upright_shape(Sign width, Sign length, Sign height) {
  const bool tall = height == Sign::kPlus;
  if (width == Sign::kMinus || length == Sign::kMinus)
    return tall && width != Sign::kPlus && length != Sign::kPlus ? OpeningShape::kVerticalCylinder
                                                                 : OpeningShape::kEllipse;
  if (tall) return OpeningShape::kBox;
  if (width == Sign::kPlus && length == Sign::kPlus) return OpeningShape::kRectangle;
  return width == Sign::kZero && length == Sign::kZero ? OpeningShape::kPoint : OpeningShape::kLine;
}

/// Shape of an opening whose height is negative, that is round in a vertical plane.
OpeningShape bulging_shape(Sign width, Sign length, bool since_2002) {
  if (width == Sign::kMinus && length == Sign::kMinus) return OpeningShape::kEllipsoid;
  if (width == Sign::kMinus && length == Sign::kZero)
    return since_2002 ? OpeningShape::kVerticalEllipse : OpeningShape::kEllipsoid;
  if (width == Sign::kMinus || length == Sign::kMinus)
    return since_2002 ? OpeningShape::kHorizontalCylinder : OpeningShape::kEllipsoid;
  if (width == Sign::kZero || length == Sign::kZero) return OpeningShape::kHorizontalCylinder;
  return OpeningShape::kBox;
}

/// Concentric map of the unit square to the unit disc; equal areas stay equal and neighbours stay neighbours.
Vec2 to_disc(const Vec2& unit) {
  const double a = 2.0 * unit.x - 1.0;
  const double b = 2.0 * unit.y - 1.0;
  if (a == 0.0 && b == 0.0) return {0.0, 0.0};
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

LuminousOpening opening_from_lm63(double width_m, double length_m, double height_m, int format_year) {
  const Sign width = sign_of(width_m);
  const Sign length = sign_of(length_m);
  const Sign height = sign_of(height_m);
  LuminousOpening opening;
  opening.shape = height == Sign::kMinus ? bulging_shape(width, length, format_year >= 2002)
                                         : upright_shape(width, length, height);
  opening.length_m = length == Sign::kZero ? 0.0 : std::abs(length_m);
  opening.width_m = width == Sign::kZero ? 0.0 : std::abs(width_m);
  opening.height_m = height == Sign::kZero ? 0.0 : std::abs(height_m);
  if (opening.shape == OpeningShape::kVerticalEllipse) return opening;
  // The older editions give the diameter of a round shape once.
  if (round_shape(opening.shape)) {
    if (length == Sign::kZero) opening.length_m = opening.width_m;
    if (width == Sign::kZero) opening.width_m = opening.length_m;
  }
  if (opening.shape == OpeningShape::kHorizontalCylinder) {
    if (length == Sign::kZero) opening.length_m = opening.height_m;
    if (width == Sign::kZero) opening.width_m = opening.height_m;
  }
  return opening;
}

Vec3 sample(const LuminousOpening& opening, const Vec2& unit) {
  if (opening.shape == OpeningShape::kPoint) return {0.0, 0.0, 0.0};
  if (!round_shape(opening.shape))
    return {(unit.x - 0.5) * opening.length_m, (unit.y - 0.5) * opening.width_m, 0.0};
  const Vec2 disc = to_disc(unit);
  if (opening.shape == OpeningShape::kVerticalEllipse)
    return {0.0, disc.x * 0.5 * opening.width_m, disc.y * 0.5 * opening.height_m};
  return {disc.x * 0.5 * opening.length_m, disc.y * 0.5 * opening.width_m, 0.0};
}

std::vector<Vec3> sample_grid(const LuminousOpening& opening, int n_length, int n_width) {
  int nu = std::max(1, n_length);
  int nv = std::max(1, n_width);
  if (opening.shape == OpeningShape::kPoint) nu = nv = 1;
  if (opening.shape == OpeningShape::kLine) {
    const int n = std::max(nu, nv);
    nu = opening.length_m > 0.0 ? n : 1;
    nv = opening.length_m > 0.0 ? 1 : n;
  }
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv));
  for (int u = 0; u < nu; ++u)
    for (int v = 0; v < nv; ++v) points.push_back(sample(opening, {(u + 0.5) / nu, (v + 0.5) / nv}));
  return points;
}

std::vector<Vec3> outline(const LuminousOpening& opening) {
  if (!(area_m2(opening) > 0.0)) return {};
  const bool upright = opening.shape == OpeningShape::kVerticalEllipse;
  const double a = (upright ? opening.width_m : opening.length_m) / 2.0;
  const double b = (upright ? opening.height_m : opening.width_m) / 2.0;
  std::vector<Vec3> ring;
  const auto add = [&](double x, double y) {
    ring.push_back(upright ? Vec3(0.0, x, y) : Vec3(x, y, 0.0));
  };
  if (!round_shape(opening.shape)) {
    add(-a, -b), add(a, -b), add(a, b), add(-a, b);
    return ring;
  }
  // Corners a little outside, so that the area is that of the round shape.
  const double turn = 2.0 * kPi / kRoundCorners, swell = std::sqrt(turn / std::sin(turn));
  for (int i = 0; i < kRoundCorners; ++i)
    add(swell * a * std::cos(i * turn), swell * b * std::sin(i * turn));
  return ring;
}

double area_m2(const LuminousOpening& opening) {
  if (opening.shape == OpeningShape::kPoint) return 0.0;
  if (opening.shape == OpeningShape::kVerticalEllipse) return kPi / 4 * opening.width_m * opening.height_m;
  const double rectangle = opening.length_m * opening.width_m;
  return round_shape(opening.shape) ? kPi / 4 * rectangle : rectangle;
}

double largest_dimension_m(const LuminousOpening& opening) {
  if (opening.shape == OpeningShape::kPoint) return 0.0;
  if (opening.shape == OpeningShape::kVerticalEllipse) return std::max(opening.width_m, opening.height_m);
  return std::max(opening.length_m, opening.width_m);
}

}  // namespace dim
