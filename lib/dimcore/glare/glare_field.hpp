#pragma once

#include <memory>
#include <vector>

#include "geometry/ray_caster.hpp"
#include "glare/luminous_area.hpp"
#include "glare/ugr.hpp"
#include "result/luminous.hpp"

namespace dim {

/// What an eye at one place sees, whichever way it turns.
struct EyePlace {
  std::vector<GlareSource> sources;    ///< luminaires, the hidden part taken off
  std::vector<Vec3> directions;        ///< of the sphere, each of the same solid angle
  std::vector<float> luminance_cd_m2;  ///< of the surfaces there; luminaires left out
  bool enclosed = false;  ///< most of what it sees are the insides of things: the eye is in one, or outside
};

/// Vertical illuminance over pi that surfaces bring to an eye, cd/m2: the background of UGR.
double background_cd_m2(const EyePlace& place, const LineOfSight& sight);

/// UGR there; NaN also for an enclosed eye.
UnifiedGlareRating glare_at(const EyePlace& place, const LineOfSight& sight);

/// The luminaires and lit surfaces of a room, to be looked at. Luminance of a luminaire is its intensity
/// towards the eye over its projected luminous area; where something stands before a part of it, that part is
/// taken off. Surfaces have the luminance of their cells, shiny ones the mean of all directions. Luminaires
/// seen in mirrors, and daylight through windows, are no sources here.
class GlareField {
 public:
  GlareField(const LuminanceDatabase& database, const Mix& mix);

  /// @param eye  zone-centred
  EyePlace at(const Vec3& eye) const;

 private:
  double visible_share(const ShownLuminaire& luminaire, const Vec3& eye) const;
  float luminance_cd_m2(const Hit& hit, const Vec3& direction) const;

  const LuminanceDatabase& database_;
  std::vector<double> factor_;     // [n_luminaires]
  std::vector<float> cell_cd_m2_;  // [n_cells]
  std::vector<Vec3> directions_;
  RayCaster caster_;
};

}  // namespace dim
