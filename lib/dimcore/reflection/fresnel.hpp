#pragma once

namespace dim {

/// Fresnel reflectance for unpolarised light, equation (12) for a complex index n - i k.
///
/// Written with N^2 - 1 taken out of the differences, so that nothing cancels near normal or grazing
/// incidence or near n = 1 (where it is 0), and 0/0 does not occur: at normal incidence ((n-1)^2 +
/// k^2)/((n+1)^2 + k^2).
/// @param cos_incidence  0..1
/// @param n, k           relative refractive index > 0 and extinction >= 0
double fresnel_reflectance(double cos_incidence, double n, double k = 0.0);

/// The two polarisations apart: s, perpendicular to the plane of incidence, and p, in it.
struct PolarisedReflectance {
  double s = 0.0, p = 0.0;
};
PolarisedReflectance fresnel_polarised(double cos_incidence, double n, double k = 0.0);

}  // namespace dim
