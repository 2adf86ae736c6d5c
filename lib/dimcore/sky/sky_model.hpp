#pragma once

#include <vector>

#include "base/vec.hpp"
#include "sky/efficacy.hpp"

namespace dim {

/// How the luminance of a sky is spread, up to a factor:
///   gradation (1 + a exp(b / sin altitude)) x indicatrix (k + c exp(d chi) + e cos^2 chi),
/// chi the angle from the sun. CIE S 011:2003 (ISO 15469:2004) with k = 1 - c exp(d pi/2), Perez, Seals &
/// Michalsky 1993 with k = 1; the traditional overcast sky (1 + 2 sin altitude)/3; or a luminance for each of
/// 145 patches.
class SkyModel {
 public:
  static SkyModel uniform();
  /// Traditional overcast sky (Moon & Spencer 1942), three times as bright at the zenith as at the horizon.
  static SkyModel overcast();
  /// @param type  1..15. @throws InternalError  any other
  static SkyModel cie(int type);
  /// @param sun_zenith_rad  0..pi/2
  static SkyModel perez(const SkyClearness& state, double sun_zenith_rad);
  /// @param luminances  of the patches of SkyPatches(1), >= 0. @throws InternalError  not 145
  static SkyModel table(std::vector<double> luminances);

  /// Relative luminance in a direction above the horizon, >= 0. A level direction counts as 0.01 above it for
  /// Perez, whose gradation may grow without bound there.
  double operator()(const Vec3& direction, const Vec3& sun) const;
  /// Whether the sun's place matters.
  bool is_table() const { return form_ == Form::table; }
  bool follows_sun() const { return c_ != 0.0 || e_ != 0.0; }

 private:
  enum class Form { gradation, overcast, table };
  Form form_ = Form::gradation;
  double a_ = 0.0, b_ = -1.0, c_ = 0.0, d_ = -1.0, e_ = 0.0, k_ = 1.0, least_sine_ = 1e-9;
  std::vector<double> table_;
};

/// A sky scaled to the horizontal illuminance it gives.
class Sky {
 public:
  /// @param sun            unit vector to the sun, above the horizon; whatever for a model that does not
  /// follow it
  /// @param horizontal_lx  unobstructed horizontal illuminance of the sky alone, >= 0
  /// @error 1e-6 of the horizontal illuminance for the CIE skies (tests/unit/sky_model_test)
  Sky(SkyModel model, const Vec3& sun, double horizontal_lx);

  /// Luminance in a direction of the sky's frame, cd/m2; 0 below the horizon.
  double luminance_cd_m2(const Vec3& direction) const {
    return direction.z > 0.0 ? scale_ * model_(direction, sun_) : 0.0;
  }
  double horizontal_lx() const { return horizontal_lx_; }
  const SkyModel& model() const { return model_; }
  /// Where the model has the sun.
  const Vec3& sun() const { return sun_; }
  /// cd/m2 for a relative luminance of 1.
  double scale_cd_m2() const { return scale_; }

 private:
  SkyModel model_;
  Vec3 sun_;
  double horizontal_lx_;
  double scale_;
};

/// Factor from a model's relative luminance to cd/m2. @throws InternalError  light from a model without any
double sky_scale(double horizontal_lx, double relative_horizontal_sr);

}  // namespace dim
