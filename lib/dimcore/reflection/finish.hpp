#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spectrum/curve.hpp"

namespace dim {

class KlemsMatrix;

enum class FinishKind { opaque, glazing };

/// Refractive index of window glass, where nobody says another.
inline constexpr double kGlassIndex = 1.52;

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
  /// Glazing: "glass" (Fresnel's slab of `ior`), "constant" at every angle, "table" (`by_angle`), "diffusing"
  /// (evenly in all directions) or "bsdf" (`bsdf`).
  std::string angular_law = "glass";
  /// Table: {degrees from normal, transmittance over that at normal incidence}, ascending from 0 to 90.
  std::vector<std::pair<double, double>> by_angle;
  double direct = 0.0;  ///< diffusing: part of the transmittance that goes straight on, after the slab's law
  std::shared_ptr<const KlemsMatrix> bsdf;
  std::string source;                 ///< database entry or "inline"

  bool is_diffuse() const { return kind == FinishKind::opaque && specular == 0.0; }
};

}  // namespace dim
