#include "transport/auto_bands.hpp"

#include <set>

#include "reflection/fresnel.hpp"
#include "spectrum/observer.hpp"

namespace dim {
namespace {

// Fresnel's F at normal incidence, physics.md section 6.
double normal_reflectance(const Finish& finish, double nm) {
  if (finish.specular_reflectance) return finish.specular_reflectance->at(nm);
  return fresnel_reflectance(1.0, finish.ior.at(nm), finish.extinction ? finish.extinction->at(nm) : 0.0);
}

void add_curves(const Finish& finish, std::vector<SpectralCurve>& curves) {
  curves.push_back(finish.diffuse);
  if (finish.kind == FinishKind::glazing) {
    curves.push_back(finish.transmittance);
    return;
  }
  if (finish.specular == 0.0) return;
  LatticeValues facets, whole;
  for (std::size_t i = 0; i < kTableSize; ++i) {
    facets[i] = finish.specular * normal_reflectance(finish, lattice_nm(i));
    whole[i] = facets[i] + (1.0 - finish.specular) * finish.diffuse.at(lattice_nm(i));
  }
  curves.push_back(curve_of(facets));
  curves.push_back(curve_of(whole));
}

}  // namespace

BandChoice auto_bands(const Zone& zone, const Lights& lights, const BandAccuracy& accuracy) {
  std::set<int> fittings, finishes;
  for (const auto& luminaire : lights.luminaires) fittings.insert(luminaire.fitting);
  for (const auto& surface : zone.surfaces) finishes.insert(surface.finish);
  std::vector<SpectralCurve> spectra, reflectances;
  for (const int fitting : fittings)
    spectra.push_back(lights.fittings[static_cast<std::size_t>(fitting)].spectrum);
  for (const int finish : finishes) add_curves(zone.finishes[static_cast<std::size_t>(finish)], reflectances);
  return choose_bands(spectra, reflectances, accuracy);
}

}  // namespace dim
