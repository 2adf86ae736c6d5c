#include "photometry/photometry.hpp"

#include <algorithm>
#include <cmath>

namespace dim {

double tilt_factor(const LampTilt& tilt, double tilt_rad) {
  constexpr double kSlack_rad = 1e-6;
  const auto& angle = tilt.angle_rad;
  const double wanted =
      tilt_rad > kPi / 2 && angle.back() <= kPi / 2 + kSlack_rad ? kPi - tilt_rad : tilt_rad;
  const auto above = std::upper_bound(angle.begin(), angle.end(), wanted);
  if (above == angle.begin()) return tilt.factor.front();
  if (above == angle.end()) return tilt.factor.back();
  const auto i = static_cast<std::size_t>(above - angle.begin());
  const double share = (wanted - angle[i - 1]) / (angle[i] - angle[i - 1]);
  return tilt.factor[i - 1] + (tilt.factor[i] - tilt.factor[i - 1]) * share;
}

const char* symmetry_name(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::kAxial:
      return "axial";
    case Symmetry::kQuadrilateral:
      return "quadrilateral";
    case Symmetry::kBilateral0_180:
      return "bilateral 0-180";
    case Symmetry::kBilateral90_270:
      return "bilateral 90-270";
    case Symmetry::kLateral:
      return "symmetric 0-90";
    case Symmetry::kNone:
      break;
  }
  return "none";
}

std::string Photometry::keyword(const std::string& name) const {
  for (const auto& [key, value] : keywords)
    if (key == name) return value;
  return {};
}

}  // namespace dim
