#include "spectrum/colour.hpp"

#include <cmath>
#include <limits>

namespace dim {
namespace {

Vec2 over(double a, double b, double sum) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  return sum > 0.0 ? Vec2(a / sum, b / sum) : Vec2(kNaN, kNaN);
}

double lab_root(double t) {
  constexpr double kEdge = 6.0 / 29.0;
  return t > kEdge * kEdge * kEdge ? std::cbrt(t) : t / (3.0 * kEdge * kEdge) + 4.0 / 29.0;
}

double hue_rad(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double h = std::atan2(b, a);
  return h < 0.0 ? h + 2.0 * kPi : h;
}

double pow7(double x) { return x * x * x * x * x * x * x; }

double root_share_of_25(double chroma) {
  static const double k25 = pow7(25.0);
  return std::sqrt(pow7(chroma) / (pow7(chroma) + k25));
}

}  // namespace

Vec2 xy_of(const Vec3& xyz) { return over(xyz.x, xyz.y, xyz.x + xyz.y + xyz.z); }

Vec2 uv_1976_of(const Vec3& xyz) {
  return over(4.0 * xyz.x, 9.0 * xyz.y, xyz.x + 15.0 * xyz.y + 3.0 * xyz.z);
}

Vec2 uv_1960_of(const Vec3& xyz) {
  return over(4.0 * xyz.x, 6.0 * xyz.y, xyz.x + 15.0 * xyz.y + 3.0 * xyz.z);
}

Lab lab_of(const Vec3& xyz, const Vec3& white_xyz) {
  const Vec3 ratio = xyz / white_xyz;
  const Vec3 f(lab_root(ratio.x), lab_root(ratio.y), lab_root(ratio.z));
  return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

double delta_e_2000(const Lab& one, const Lab& other) {
  // Symbols and numbers of equations as in Sharma, Wu and Dalal 2005.
  const double mean_c = (std::hypot(one.a, one.b) + std::hypot(other.a, other.b)) / 2.0;
  const double g = 0.5 * (1.0 - root_share_of_25(mean_c));  // 4
  const double a1 = (1.0 + g) * one.a, a2 = (1.0 + g) * other.a;
  const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, other.b);
  const double h1 = hue_rad(a1, one.b), h2 = hue_rad(a2, other.b);
  double dh = c1 * c2 == 0.0 ? 0.0 : h2 - h1;  // 10
  if (dh > kPi) dh -= 2.0 * kPi;
  if (dh < -kPi) dh += 2.0 * kPi;
  const double dl = other.l - one.l, dc = c2 - c1;
  const double d_hue = 2.0 * std::sqrt(c1 * c2) * std::sin(dh / 2.0);  // 11
  const double l = (one.l + other.l) / 2.0, c = (c1 + c2) / 2.0;
  double h = h1 + h2;  // 14
  if (c1 * c2 != 0.0) {
    if (std::abs(h1 - h2) > kPi) h += h < 2.0 * kPi ? 2.0 * kPi : -2.0 * kPi;
    h /= 2.0;
  }
  const double t = 1.0 - 0.17 * std::cos(h - radians(30.0)) + 0.24 * std::cos(2.0 * h) +
                   0.32 * std::cos(3.0 * h + radians(6.0)) - 0.20 * std::cos(4.0 * h - radians(63.0));  // 15
  const double from_blue = (degrees(h) - 275.0) / 25.0;
  const double rotation = radians(30.0) * std::exp(-from_blue * from_blue);  // 16
  const double square = (l - 50.0) * (l - 50.0);
  const double s_l = 1.0 + 0.015 * square / std::sqrt(20.0 + square);  // 18
  const double s_c = 1.0 + 0.045 * c, s_h = 1.0 + 0.015 * c * t;
  const double r_t = -std::sin(2.0 * rotation) * 2.0 * root_share_of_25(c);  // 21
  const double el = dl / s_l, ec = dc / s_c, eh = d_hue / s_h;
  return std::sqrt(std::max(0.0, el * el + ec * ec + eh * eh + r_t * ec * eh));
}

}  // namespace dim
