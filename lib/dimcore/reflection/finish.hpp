#pragma once

#include <optional>
#include <string>

#include "spectrum/curve.hpp"

namespace dim {

enum class FinishKind { opaque, glazing };

/// Optical properties of a surface, physics.md section 6: rho = k_s rho_s + k_d rho_d, k_s + k_d = 1.
struct Finish {
  std::string name;
  FinishKind kind = FinishKind::opaque;
  SpectralCurve diffuse;                              ///< rho_d, 0..1; of a glazing: its reflectance
  double specular = 0.0;                              ///< k_s, 0..1
  double roughness = 0.0;                             ///< m, RMS facet slope
  SpectralCurve ior{1.5};                             ///< eta
  std::optional<SpectralCurve> extinction;            ///< kappa, conductors
  std::optional<SpectralCurve> specular_reflectance;  ///< measured constant in place of Fresnel's F
  std::string distribution = "gaussian";              ///< or "beckmann"
  SpectralCurve transmittance;                        ///< glazing, at normal incidence
  std::string angular_law = "glass";  ///< glazing: "glass" (Fresnel, a pane) or "constant" at every angle
  std::string source;                 ///< database entry or "inline"

  bool is_diffuse() const { return kind == FinishKind::opaque && specular == 0.0; }
};

}  // namespace dim
