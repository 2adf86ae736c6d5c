#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.hpp"

namespace dim {

/// The full Klems basis: 145 patches of the hemisphere in nine rings. Directions are those in which light
/// travels, into the room, on either side of the glazing: straight through stays in its patch. Their frame is
/// z into the room, y up, x to the right as seen from inside; azimuth from x towards y.
namespace klems {

inline constexpr std::size_t kPatches = 145;

/// @param direction  unit, z > 0
std::size_t patch_of(const Vec3& direction);

/// Integral of the cosine over a patch, sr; those of all add up to pi.
double projected_solid_angle_sr(std::size_t patch);

/// Direction for (a, b) in [0, 1) x [0, 1), spread over the patch in proportion to the cosine.
Vec3 direction(std::size_t patch, double a, double b);

}  // namespace klems

/// How a glazing passes light on by patches of the Klems basis.
class KlemsMatrix {
 public:
  /// @param btdf_per_sr  [145 out, 145 in] transmitted radiance over the irradiance that comes in, >= 0
  explicit KlemsMatrix(std::vector<double> btdf_per_sr) : btdf_per_sr_(std::move(btdf_per_sr)) {}

  double btdf_per_sr(std::size_t out, std::size_t in) const { return btdf_per_sr_[out * klems::kPatches + in]; }
  const std::vector<double>& values() const { return btdf_per_sr_; }

  /// Share of light from a patch that is passed in all directions.
  double transmittance(std::size_t in) const;
  /// The same of light from all sides evenly.
  double hemispherical_transmittance() const;

 private:
  std::vector<double> btdf_per_sr_;
};

}  // namespace dim
