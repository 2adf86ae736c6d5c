#include "transport/auto_bands.hpp"

#include <map>
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

std::vector<SpectralCurve> reflectances(const Zone& zone) {
  std::set<int> finishes;
  for (const auto& surface : zone.surfaces) finishes.insert(surface.finish);
  std::vector<SpectralCurve> curves;
  for (const int finish : finishes) add_curves(zone.finishes[static_cast<std::size_t>(finish)], curves);
  return curves;
}

}  // namespace

LampSpectra lamp_spectra(const Lights& lights) {
  std::map<int, double> flux_lm;
  for (const auto& luminaire : lights.luminaires)
    flux_lm[luminaire.fitting] +=
        luminaire.factor * lights.fitting_of(luminaire).intensity.flux_lm();
  LampSpectra lamps;
  for (const auto& [fitting, flux] : flux_lm) {
    lamps.spectra.push_back(lights.fittings[static_cast<std::size_t>(fitting)].spectrum);
    lamps.flux_lm.push_back(flux);
  }
  if (!lights.sky) return lamps;
  // How much of it comes in is not known yet: as much as falls on a square metre outside.
  const auto& now = lights.sky->now;
  lamps.spectra.push_back(lights.sky->sky_spectrum);
  lamps.flux_lm.push_back(now ? now->sky.horizontal_lx() : 1.0);
  if (now && now->direct_normal_lx > 0.0) {
    lamps.spectra.push_back(lights.sky->sun_spectrum);
    lamps.flux_lm.push_back(now->direct_normal_lx);
  }
  return lamps;
}

BandChoice auto_bands(const Zone& zone, const LampSpectra& lamps, const BandAccuracy& accuracy) {
  return choose_bands(lamps.spectra, reflectances(zone), accuracy);
}

BandChoice judged_bands(const Zone& zone, const LampSpectra& lamps, const Bands& bands) {
  const LatticeValues weights = luminous_weights(lamps.spectra, lamps.flux_lm);
  return judge_bands(lamps.spectra, reflectances(zone), bands, bands.size() == 1 ? &weights : nullptr);
}

}  // namespace dim
