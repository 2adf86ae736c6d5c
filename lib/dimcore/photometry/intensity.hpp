#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.hpp"
#include "photometry/angle.hpp"
#include "photometry/angle_grid.hpp"

namespace dim {

/// The three grids of directions (LM-63 "photometric type"; C-gamma, B-beta and A-alpha of CIE 121 and
/// EN 13032-1). In the luminaire's frame (x = C0, y = C90, z = aim):
///   C: (sin gamma cos C, sin gamma sin C, cos gamma)
///   B: (sin H, cos H sin V, cos H cos V), solid angle cos(H) dH dV
///   A: (cos V sin H, sin V, cos V cos H), solid angle cos(V) dH dV
/// so that H = V = 0 is the aim, H grows towards C0 and V towards C90. A floodlight aimed level with
/// c0 to its right (seen from behind) has positive H on the right and positive V upwards.
enum class PhotometricType { kC = 1, kB = 2, kA = 3 };

/// Luminous intensity on the grid it was measured on, expanded from the file's symmetry. All three types are
/// planes that meet in a polar axis: type C in the aim, type B in C0 - C180, type A in C90 - C270.
struct IntensityDistribution {
  /// Angle of the planes, ascending. Type C: C, 0 to 2 pi inclusive; {0, 2 pi} where rotationally symmetric.
  /// Type B: V, type A: H, within -pi..pi; no light outside the first and last plane.
  std::vector<double> c_rad;
  /// Angle from the pole, ascending within 0..pi; no light outside the first and last angle. Type C: gamma;
  /// type B: H + pi/2; type A: V + pi/2.
  std::vector<double> gamma_rad;
  std::vector<double> intensity_cd;  ///< [n_c * n_gamma], gamma fastest, >= 0
  PhotometricType type = PhotometricType::kC;
};

/// Luminous intensity in any direction, ready for many calls from many threads.
///
/// A table is interpolated linearly in both angles of its own type and is zero outside their range; isotropic
/// and Lambertian sources are evaluated exactly. Directions are in the luminaire's frame: x = C0, y = C90, z
/// = aim (gamma = 0), each component a dot product with that unit vector. (With C counted as LM-63 counts it
/// this frame is left-handed; C90 = C0 x aim.)
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
    if (kind_ == Kind::kTurnedTable) return at_turned(dir_local);
    const double gamma = half_turn_angle(std::sqrt(across2), dir_local.z);
    if (!gamma_.contains(gamma)) return 0.0;
    if (axial_) return along_gamma(0, gamma_.locate(gamma));
    return between_planes(whole_turn_angle(dir_local.y, dir_local.x), gamma);
  }

  /// @param c_rad      any finite angle
  /// @param gamma_rad  0..pi
  double at_c_gamma(double c_rad, double gamma_rad) const;

  /// A direction of emission: drawn nearly in proportion to the intensity, whatever the width of the beam.
  struct Emission {
    Vec3 direction{0.0};  ///< unit
    double weight = 0.0;  ///< flux it stands for over the mean: the mean of all is 1
  };
  /// The emission that belongs to (a, b) of the unit square: the part of the table between neighbouring angles
  /// by its flux, evenly over its solid angle. Where there is no flux, the aim with weight 0.
  Emission emission(double a, double b) const;

  /// Flux in lm: the exact integral of what `at` returns over the sphere.
  double flux_lm() const { return flux_lm_; }
  /// Largest intensity in any direction, cd.
  double max_cd() const { return max_cd_; }
  /// True where nothing is emitted at gamma > 90 degrees.
  bool zero_behind() const { return zero_behind_; }
  /// A bound from above on the intensity in all directions within `half_angle_rad` of `dir_local`, cd: 0 only
  /// where there is no light at all.
  double bound_cd(const Vec3& dir_local, double half_angle_rad) const;
  bool is_lambertian() const { return kind_ == Kind::kLambertian; }
  /// True where the intensity does not depend on C.
  bool axial() const { return axial_; }

 private:
  enum class Kind { kTable, kIsotropic, kLambertian, kTurnedTable };
  IntensityTable(Kind kind, double intensity_cd);

  double at_turned(const Vec3& dir_local) const;
  void check_angles() const;

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
  void summarise_emission();
  Vec3 direction_of(double plane_rad, double from_pole_rad) const;
  bool lit_behind(const std::vector<double>& plane_max_cd, std::size_t lit_end) const;

  Kind kind_ = Kind::kTable;
  PhotometricType type_ = PhotometricType::kC;
  bool axial_ = true;
  bool zero_behind_ = false;
  double max_cd_ = 0.0;
  double flux_lm_ = 0.0;
  std::size_t n_gamma_ = 0;
  AngleGrid c_;
  AngleGrid gamma_;
  std::vector<double> cd_;
  std::vector<double> ring_max_cd_;  // [n_gamma] over all planes; type C only
  std::vector<double> emitted_;  // [(n_c - 1) * (n_gamma - 1) + 1] flux of parts before each, roughly, lm
};

}  // namespace dim
