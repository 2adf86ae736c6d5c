#pragma once

#include "base/vec.hpp"
#include "reflection/finish.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// Reflectance of an opaque finish at normal incidence, diffuse and specular together:
/// k_d rho_d + k_s F, F being the stated specular reflectance or Fresnel's ((n-1)^2 + k^2)/((n+1)^2 + k^2).
/// Of a glazing its reflectance.
double reflectance_at(const Finish& finish, double wavelength_nm);

/// Tristimulus values of what a finish reflects (a glazing: lets through) at normal incidence, relative to a
/// perfect diffuser under the same light: Y is the luminous reflectance or transmittance. CIE 1931, sums over
/// 380..780 nm every nanometre.
/// @param illuminant  relative, positive somewhere
Vec3 finish_xyz(const Finish& finish, const SpectralCurve& illuminant);

/// Tristimulus values of the illuminant itself on the same scale, Y = 1.
Vec3 white_xyz(const SpectralCurve& illuminant);

}  // namespace dim
