#pragma once

#include <string>
#include <vector>

#include "light/obstructions.hpp"
#include "light/window.hpp"
#include "sky/sky_patches.hpp"

namespace dim {

/// What falls on the outer faces of a group of windows, as a sensor on the facade would measure it: sky, ground and sun
/// past everything that stands outside. Light that surroundings reflect is left out.
class OuterFace {
 public:
  /// @param zone  must outlive this
  /// @param group  of windows with glass or openings; what is open in other ways has no face
  OuterFace(const Zone& zone, const std::string& group, int subdivision);

  /// Whether the group has a face.
  bool exists() const { return area_m2_ > 0.0; }
  /// Illuminance of the mean of the faces by a column of SkyPatches at 1 cd/m2, lx. [n_columns]
  const std::vector<double>& column_lx() const { return column_lx_; }
  /// Illuminance by the sun's beam over that across it. @param towards  unit vector of the sky's frame
  double sun_factor(const Vec3& towards) const;

 private:
  double north_rad_;
  Obstructions obstructions_;
  Windows windows_;
  std::vector<std::size_t> members_;
  double area_m2_ = 0.0;
  std::vector<double> column_lx_;
};

}  // namespace dim
