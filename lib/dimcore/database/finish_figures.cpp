#include "database/finish_figures.hpp"

#include "spectrum/bands.hpp"
#include "spectrum/observer.hpp"

namespace dim {
namespace {

double fresnel_at_normal(double n, double k) {
  return ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
}

template <class Factor>
Vec3 xyz_under(const SpectralCurve& illuminant, Factor&& factor) {
  const Observer& observer = cie_1931_observer();
  Vec3 sum(0.0);
  double white_y = 0.0;
  for (double nm = kVisibleLow_nm; nm <= kVisibleHigh_nm; nm += 1.0) {
    const double light = illuminant.at(nm);
    const Vec3 seen = light * Vec3(observer.x.at(nm), observer.y.at(nm), observer.z.at(nm));
    sum += factor(nm) * seen;
    white_y += seen.y;
  }
  return sum / white_y;
}

}  // namespace

double reflectance_at(const Finish& finish, double wavelength_nm) {
  const double diffuse = finish.diffuse.at(wavelength_nm);
  if (finish.kind == FinishKind::glazing || finish.specular == 0.0) return diffuse;
  const double specular =
      finish.specular_reflectance
          ? finish.specular_reflectance->at(wavelength_nm)
          : fresnel_at_normal(finish.ior.at(wavelength_nm),
                              finish.extinction ? finish.extinction->at(wavelength_nm) : 0.0);
  return (1.0 - finish.specular) * diffuse + finish.specular * specular;
}

Vec3 finish_xyz(const Finish& finish, const SpectralCurve& illuminant) {
  const bool glazing = finish.kind == FinishKind::glazing;
  return xyz_under(illuminant, [&](double nm) {
    return glazing ? finish.transmittance.at(nm) : reflectance_at(finish, nm);
  });
}

Vec3 white_xyz(const SpectralCurve& illuminant) {
  return xyz_under(illuminant, [](double) { return 1.0; });
}

}  // namespace dim
