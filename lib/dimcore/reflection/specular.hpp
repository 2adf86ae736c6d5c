#pragma once

#include <optional>

#include "reflection/facets.hpp"
#include "reflection/finish.hpp"
#include "spectrum/lattice.hpp"

namespace dim {

/// How a finish reflects in one waveband: rho = k_s rho_s + k_d rho_d, equation (10), k_s + k_d = 1.
struct BandReflection {
  double diffuse = 0.0;   ///< k_d rho_d
  double specular = 0.0;  ///< k_s
  double n = 1.5, k = 0.0;
  std::optional<double> constant;  ///< measured specular reflectance in place of Fresnel's F
  double transmittance = 0.0;      ///< of a glazing, at normal incidence

  /// k_s F. @param cos_incidence on the facet, 0..1
  double fresnel(double cos_incidence) const;
  bool operator==(const BandReflection&) const = default;
};

/// Band means of a finish's curves.
BandReflection band_reflection(const Finish& finish, double low_nm, double high_nm);

/// Means over the visible range with weights that add up to 1 (luminous_weights): one band in which diffuse
/// reflection has the luminous reflectance.
BandReflection weighted_reflection(const Finish& finish, const LatticeValues& weights);

FacetDistribution facet_distribution(const Finish& finish);

/// Specular part of the reflectance distribution, k_s F D G / (4 cos(i) cos(r)), 1/sr, equation (11). Exactly
/// reciprocal. Directions in the surface's frame, z > 0, away from it.
double specular_brdf(const BandReflection& reflection, const Facets& facets, const Vec3& in, const Vec3& out);

/// The same without k_s F, which is left to `reflection.fresnel(facing)`: D G / (4 cos(i) cos(r)).
struct LobeValue {
  double value = 0.0;   ///< 1/sr
  double facing = 1.0;  ///< cosine of incidence on the facets
};
LobeValue lobe_value(const Facets& facets, const Vec3& in, const Vec3& out);

/// Share of light from a direction that the specular part reflects, k_s rho_s(theta), 0..1.
/// @param facets  null for a mirror
double specular_albedo(const BandReflection& reflection, const Facets* facets, double cos_incidence);

/// The half-width of a lobe in radians: reflected directions turn twice as far as facets.
inline double lobe_half_width_rad(double rms_slope) { return 2.0 * rms_slope; }

}  // namespace dim
