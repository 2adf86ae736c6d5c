#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "sky/daylight.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// The outside of a lights file: one sky as it is at a moment, or all skies as daylight coefficients.
struct SkyLight {
  std::string model;            ///< as written
  std::optional<Daylight> now;  ///< nothing: coefficients
  int subdivision = 1;          ///< of the sky's patches: 1, 2 or 4
  double ground_reflectance = 0.2;
  SpectralCurve sky_spectrum{1.0};  ///< of sky and ground
  SpectralCurve sun_spectrum{1.0};
  std::string sky_spectrum_name, sun_spectrum_name;
  Place place;
};

}  // namespace dim
