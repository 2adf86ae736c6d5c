#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// The part of the sky between two altitudes and two azimuths. Turns run from east (+x) anticlockwise through
/// north here, as the numbering of patches does.
struct SkyBox {
  double low_rad, high_rad;    ///< altitude
  double first_rad, last_rad;  ///< turn from east
};

/// The sky vault cut into patches (Tregenza 1987: 145 in bands of 12 degrees and a cap; Reinhart 2001: each
/// band into 2 or 4, each of its patches likewise, bands of equal height: 577 and 2,305), and the ground as
/// one more.
///
/// What lights a building is a sum over *columns*: the patches, each of even luminance, the ground, and for every band
/// but the cap a *ramp*, which rises with the sine of the altitude from 0 at the band's lower edge to 1 cd/m2 at the
/// upper one and has the mean 1/2 in each of its patches.
///
/// Numbered band by band from the horizon up, the cap last; in a band the first patch has its middle in the
/// east and the others follow anticlockwise through north. The ground is patch size().
class SkyPatches {
 public:
  /// @param subdivision  1, 2 or 4
  /// @throws InternalError  any other
  explicit SkyPatches(int subdivision = 1);

  int subdivision() const { return subdivision_; }
  std::size_t size() const { return boxes_.size(); }
  std::size_t ground() const { return boxes_.size(); }
  std::size_t n_ramps() const { return first_.size() - 2; }
  /// The column of a band's ramp. @param band  from the horizon up, below n_ramps()
  std::size_t ramp(std::size_t band) const { return ground() + 1 + band; }
  std::size_t n_columns() const { return ground() + 1 + n_ramps(); }

  /// Patches of a band: from first_of_band(band) to first_of_band(band + 1). @param band  up to n_ramps(), the cap
  std::size_t first_of_band(std::size_t band) const { return first_[band]; }
  /// n_ramps() for the cap. @param patch  below size()
  std::size_t band_of(std::size_t patch) const { return band_[patch]; }
  /// Sine of the altitude of a band's lower edge. @param band  up to n_ramps(), the cap
  double sine(std::size_t band) const { return sine_[band]; }
  /// A band's ramp in a direction of that band, cd/m2. @param band  below n_ramps()
  double ramp_cd_m2(std::size_t band, double sine_of_altitude) const {
    return (sine_of_altitude - sine_[band]) / (sine_[band + 1] - sine_[band]);
  }

  /// @param patch  below size()
  const SkyBox& box(std::size_t patch) const { return boxes_[patch]; }
  /// Exact; 2 pi for the ground.
  double solid_angle_sr(std::size_t patch) const;
  /// Integral of sin(altitude) over the patch, exact: what it adds to the horizontal illuminance per cd/m2.
  /// The patches of the sky add up to pi. @param patch  below size()
  double horizontal_sr(std::size_t patch) const;
  /// Integral of cos(altitude) over the patch, exact: pi times what it adds to the cylindrical illuminance,
  /// the mean of all vertical ones. @param patch  below size()
  double cylinder_sr(std::size_t patch) const;
  /// What a ramp less 1/2 adds in one patch of its band to horizontal_sr and to cylinder_sr, exact.
  double ramp_horizontal_sr(std::size_t band) const;
  double ramp_cylinder_sr(std::size_t band) const;
  /// Middle in altitude and azimuth; the zenith for the cap, straight down for the ground.
  Vec3 centre(std::size_t patch) const;
  /// The patch that a direction belongs to; the ground where it is level or points down.
  std::size_t patch_of(const Vec3& direction) const;
  /// A direction inside a patch (or the ground), uniform in solid angle. @param s, t  in [0, 1)
  Vec3 direction(std::size_t patch, double s, double t) const;

 private:
  int subdivision_;
  double band_rad_;                 ///< height of every band but the cap
  std::vector<std::size_t> first_;  ///< patch of each band, the cap too, and size()
  std::vector<std::size_t> band_;   ///< of each patch
  std::vector<double> sine_;        ///< of the lower edge of each band, the cap too
  std::vector<SkyBox> boxes_;
};

}  // namespace dim
