#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.hpp"
#include "photometry/angle.hpp"
#include "photometry/angle_grid.hpp"

namespace dim {

/// Luminous intensity on a C-gamma grid (CIE and LM-63 type C), expanded from the file's symmetry to the
/// whole turn.
struct IntensityDistribution {
  std::vector<double> c_rad;      ///< ascending, 0 to 2 pi inclusive; {0, 2 pi} where rotationally symmetric
  std::vector<double> gamma_rad;  ///< ascending within 0..pi; no light outside its first and last angle
  std::vector<double> intensity_cd;  ///< [n_c * n_gamma], gamma fastest, >= 0
};

/// Luminous intensity in any direction, ready for many calls from many threads.
///
/// A table is interpolated linearly in C and in gamma and is zero outside the gamma range; isotropic and
/// Lambertian sources are evaluated exactly. Directions are in the luminaire's frame: x = C0, y = C90,
/// z = aim (gamma = 0), each component a dot product with that unit vector. (With C counted as LM-63 counts
/// it this frame is left-handed; C90 = C0 x aim.)
class IntensityTable {
 public:
  /// @throws InternalError if the arrays do not fit the description of IntensityDistribution
  explicit IntensityTable(const IntensityDistribution& distribution);
  /// The same intensity in every direction; flux 4 pi I.
  static IntensityTable isotropic(double intensity_cd);
  /// intensity_cd * cos(gamma), zero for gamma > 90 degrees; flux pi I.
  static IntensityTable lambertian(double intensity_cd);

  /// Intensity in cd towards `dir_local`, any non-zero vector of length 1e-150 to 1e150 (not
  /// only unit vectors).
  double at(const Vec3& dir_local) const {
    if (kind_ == Kind::kIsotropic) return max_cd_;
    const double across2 = dir_local.x * dir_local.x + dir_local.y * dir_local.y;
    if (kind_ == Kind::kLambertian) {
      if (dir_local.z <= 0.0) return 0.0;
      return max_cd_ * dir_local.z / std::sqrt(across2 + dir_local.z * dir_local.z);
    }
    const double gamma = half_turn_angle(std::sqrt(across2), dir_local.z);
    if (!gamma_.contains(gamma)) return 0.0;
    if (axial_) return along_gamma(0, gamma_.locate(gamma));
    return between_planes(whole_turn_angle(dir_local.y, dir_local.x), gamma);
  }

  /// @param c_rad      any finite angle
  /// @param gamma_rad  0..pi
  double at_c_gamma(double c_rad, double gamma_rad) const;

  /// Flux in lm: the exact integral of what `at` returns over the sphere.
  double flux_lm() const { return flux_lm_; }
  /// Largest intensity in any direction, cd.
  double max_cd() const { return max_cd_; }
  /// True where nothing is emitted at gamma > 90 degrees.
  bool zero_behind() const { return zero_behind_; }
  /// True where the intensity does not depend on C.
  bool axial() const { return axial_; }

 private:
  enum class Kind { kTable, kIsotropic, kLambertian };
  IntensityTable(Kind kind, double intensity_cd);

  double along_gamma(std::size_t row, const AngleGrid::Spot& g) const {
    const double* cd = cd_.data() + row + g.index;
    return cd[0] + (cd[1] - cd[0]) * g.fraction;
  }
  double between_planes(double c, double gamma) const {
    const AngleGrid::Spot g = gamma_.locate(gamma);
    const AngleGrid::Spot p = c_.locate(c);
    const std::size_t row = p.index * n_gamma_;
    const double lower = along_gamma(row, g);
    return lower + (along_gamma(row + n_gamma_, g) - lower) * p.fraction;
  }
  void summarise();

  Kind kind_ = Kind::kTable;
  bool axial_ = true;
  bool zero_behind_ = false;
  double max_cd_ = 0.0;
  double flux_lm_ = 0.0;
  std::size_t n_gamma_ = 0;
  AngleGrid c_;
  AngleGrid gamma_;
  std::vector<double> cd_;
};

}  // namespace dim
