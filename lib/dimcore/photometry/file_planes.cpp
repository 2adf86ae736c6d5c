#include "photometry/file_planes.hpp"

#include <cmath>

namespace dim {
namespace {

constexpr double kSlack_deg = 1e-6;

double rounded_degrees(double angle_rad) {
  const double rounded = std::round(degrees(angle_rad) * 1e9) / 1e9;
  return rounded == 0.0 ? 0.0 : rounded;
}

bool listed(Symmetry symmetry, double c_deg) {
  const auto within = [&](double low, double high) {
    return c_deg >= low - kSlack_deg && c_deg <= high + kSlack_deg;
  };
  switch (symmetry) {
    case Symmetry::kAxial:
      return within(0, 0);
    case Symmetry::kQuadrilateral:
      return within(0, 90);
    case Symmetry::kBilateral0_180:
      return within(0, 180);
    case Symmetry::kBilateral90_270:
      return within(90, 270);
    case Symmetry::kLateral:
      return c_deg >= -kSlack_deg;
    case Symmetry::kNone:
      break;
  }
  return true;
}

}  // namespace

FilePlanes file_planes(const IntensityDistribution& distribution, Symmetry symmetry) {
  const std::size_t n_polar = distribution.gamma_rad.size();
  const bool type_b = distribution.type == PhotometricType::kB;
  const double polar_shift_deg = distribution.type == PhotometricType::kC ? 0.0 : 90.0;
  FilePlanes file;
  std::vector<double> planes_deg, polar_deg;
  for (const double angle : distribution.c_rad) planes_deg.push_back(rounded_degrees(angle));
  for (const double angle : distribution.gamma_rad)
    polar_deg.push_back(rounded_degrees(angle - radians(polar_shift_deg)));
  // In type B the planes are those of V and the angle from the pole is H.
  const auto& horizontal = type_b ? polar_deg : planes_deg;
  file.vertical_deg = type_b ? planes_deg : polar_deg;
  for (std::size_t h = 0; h < horizontal.size(); ++h) {
    if (!listed(symmetry, horizontal[h])) continue;
    file.horizontal_deg.push_back(horizontal[h]);
    for (std::size_t v = 0; v < file.vertical_deg.size(); ++v)
      file.intensity_cd.push_back(distribution.intensity_cd[type_b ? v * n_polar + h : h * n_polar + v]);
  }
  return file;
}

}  // namespace dim
