#include "reflection/specular.hpp"

#include <cmath>

#include "reflection/fresnel.hpp"

namespace dim {

double BandReflection::fresnel(double cos_incidence) const {
  if (specular == 0.0) return 0.0;
  return specular * (constant ? *constant : fresnel_reflectance(cos_incidence, n, k));
}

namespace {

// `mean` takes a curve of the finish to its value in the band.
template <typename Mean>
BandReflection reflection_of(const Finish& finish, const Mean& mean) {
  BandReflection reflection;
  reflection.specular = finish.specular;
  reflection.diffuse = (1.0 - finish.specular) * mean(finish.diffuse);
  if (finish.kind == FinishKind::glazing) reflection.transmittance = mean(finish.transmittance);
  if (finish.specular == 0.0) return reflection;
  if (finish.specular_reflectance) {
    reflection.constant = mean(*finish.specular_reflectance);
    return reflection;
  }
  reflection.n = mean(finish.ior);
  if (finish.extinction) reflection.k = mean(*finish.extinction);
  return reflection;
}

}  // namespace

BandReflection band_reflection(const Finish& finish, double low_nm, double high_nm) {
  return reflection_of(finish, [&](const SpectralCurve& curve) { return curve.mean(low_nm, high_nm); });
}

BandReflection weighted_reflection(const Finish& finish, const LatticeValues& weights) {
  return reflection_of(finish, [&](const SpectralCurve& curve) {
    if (curve.is_flat()) return curve.max();
    const LatticeValues values = on_lattice(curve);
    double sum = 0.0;
    for (std::size_t i = 0; i < kTableSize; ++i) sum += weights[i] * values[i];
    return sum;
  });
}

FacetDistribution facet_distribution(const Finish& finish) {
  return finish.distribution == "beckmann" ? FacetDistribution::beckmann : FacetDistribution::gaussian;
}

LobeValue lobe_value(const Facets& facets, const Vec3& in, const Vec3& out) {
  if (!(in.z > 0.0) || !(out.z > 0.0)) return {};
  const Vec3 sum = in + out;
  const Vec3 half = sum / glm::length(sum);
  // i.h = r.h; taken as half the length of i + r, which is the same for both.
  const double facing = std::min(1.0, glm::length(sum) / 2.0);
  const double shadow = std::min(1.0, 2.0 * half.z * std::min(in.z, out.z) / facing);
  return {facets.density(half.z) * shadow / (4.0 * in.z * out.z), facing};
}

double specular_brdf(const BandReflection& reflection, const Facets& facets, const Vec3& in,
                     const Vec3& out) {
  const LobeValue lobe = lobe_value(facets, in, out);
  return lobe.value > 0.0 ? lobe.value * reflection.fresnel(lobe.facing) : 0.0;
}

double specular_albedo(const BandReflection& reflection, const Facets* facets, double cos_incidence) {
  if (!facets) return reflection.fresnel(cos_incidence);
  constexpr int kTilts = 96, kAzimuths = 48;  // even: opposite facets come in pairs
  const double sine = std::sqrt(std::max(0.0, 1.0 - cos_incidence * cos_incidence));
  const Vec3 in(sine, 0.0, cos_incidence);
  double sum = 0.0;
  for (int i = 0; i < kTilts; ++i) {
    const double tilt = facets->tilt_rad((i + 0.5) / kTilts);
    for (int j = 0; j < kAzimuths; ++j) {
      const double azimuth = 2.0 * kPi * (j + 0.5) / kAzimuths;
      const Vec3 half(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
      const Vec3 out = 2.0 * glm::dot(in, half) * half - in;
      const double weight = facet_weight(half, in, out);
      if (weight > 0.0) sum += weight * reflection.fresnel(std::min(1.0, glm::dot(in, half)));
    }
  }
  return std::min(reflection.specular, sum / (kTilts * kAzimuths));
}

}  // namespace dim
