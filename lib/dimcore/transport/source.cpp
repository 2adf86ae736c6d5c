#include "transport/source.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

std::string combined_name(const Luminaire& luminaire, Combine how) {
  if (how == Combine::each) return luminaire.name;
  return how == Combine::group ? luminaire.group : "all";
}

}  // namespace

CombinedSources combine(const Lights& lights, const Bands& bands, Combine how) {
  CombinedSources result;
  for (const auto& luminaire : lights.luminaires) {
    const auto& fitting = lights.fitting_of(luminaire);
    const BandWeights weights = band_weights(fitting.spectrum, bands);
    const std::string name = combined_name(luminaire, how);
    auto found = std::find_if(result.sources.begin(), result.sources.end(), [&](const Source& source) {
      return how != Combine::each && source.name == name && source.weights == weights;
    });
    if (found == result.sources.end()) {
      Source source;
      source.name = name;
      source.group = how == Combine::all ? name : luminaire.group;
      source.weights = weights;
      found = result.sources.insert(result.sources.end(), std::move(source));
    }
    found->luminaires.push_back(luminaire.name);
    found->flux_lm += luminaire.factor * fitting.intensity.flux_lm();
    result.of_luminaire.push_back(static_cast<std::size_t>(found - result.sources.begin()));
  }
  return result;
}

std::vector<Vec3> Source::xyz_by_class(const ReflectanceClasses& classes) const {
  std::vector<Vec3> xyz(classes.size(), Vec3(0.0));
  for (std::size_t b = 0; b < classes.of_band.size(); ++b)
    xyz[classes.of_band[b]] +=
        kMaxEfficacy_lm_W * watts_per_lumen(b) * Vec3(weights.x[b], weights.y[b], weights.z[b]);
  return xyz;
}

WorstBalance worst_balance(const std::vector<Source>& sources) {
  WorstBalance worst;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t b = 0; b < sources[s].energy.size(); ++b) {
      const auto& energy = sources[s].energy[b];
      if (energy.emitted_W > 0.0 && std::abs(energy.imbalance) > std::abs(worst.imbalance))
        worst = {s, b, energy.imbalance};
    }
  }
  return worst;
}

}  // namespace dim
