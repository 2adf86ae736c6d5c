#include "reflection/fresnel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace dim {
namespace {

// Amplitudes with g = N cos(refracted) = sqrt(N^2 - 1 + c^2): the usual (c - g)/(c + g) and
// (N^2 c - g)/(N^2 c + g), multiplied out by c + g.
template <class Index, class Root>
PolarisedReflectance reflectances(double c, Index excess, Index squared, Root&& root) {
  const Index g = root(excess + c * c);
  const Index sum = c + g;
  if (std::abs(sum) == 0.0) return {};  // grazing along nothing: n = 1
  const Index s = excess / (sum * sum);
  const Index p = excess * (c - 1.0 / sum) / (squared * c + g);
  const double rs = std::abs(s), rp = std::abs(p);
  return {std::min(1.0, rs * rs), std::min(1.0, rp * rp)};
}

}  // namespace

PolarisedReflectance fresnel_polarised(double cos_incidence, double n, double k) {
  const double c = std::clamp(cos_incidence, 0.0, 1.0);
  if (k == 0.0 && n >= 1.0)
    return reflectances<double>(c, (n - 1.0) * (n + 1.0), n * n, [](double x) { return std::sqrt(x); });
  using Complex = std::complex<double>;
  const Complex excess((n - 1.0) * (n + 1.0) - k * k, -2.0 * n * k);
  return reflectances<Complex>(c, excess, Complex(n, -k) * Complex(n, -k), [](const Complex& x) {
    const Complex g = std::sqrt(x);
    return g.imag() > 0.0 ? -g : g;  // the wave that dies away
  });
}

double fresnel_reflectance(double cos_incidence, double n, double k) {
  const auto polarised = fresnel_polarised(cos_incidence, n, k);
  return (polarised.s + polarised.p) / 2.0;
}

}  // namespace dim
