#include "transport/source.hpp"

#include <algorithm>
#include <cmath>

namespace dim {

std::size_t column_of(const DaylightOrigin& origin, const SkyPatches& patches) {
  if (origin.part == DaylightPart::ground) return patches.ground();
  const auto index = static_cast<std::size_t>(origin.patch);
  return origin.part == DaylightPart::ramp ? patches.ramp(index) : index;
}

namespace {

std::string combined_name(const Luminaire& luminaire, Combine how) {
  if (how == Combine::each) return luminaire.name;
  return how == Combine::group ? luminaire.group : "all";
}

// Sources of one group and state of windows with what they emit and what of it is accounted for.
struct Account {
  std::size_t first;
  double emitted_W = 0.0, open_W = 0.0;
};

bool share_account(const Source& a, const Source& b) {
  return a.daylight && b.daylight && a.group == b.group && a.daylight->state == b.daylight->state;
}

}  // namespace

CombinedSources combine(const Lights& lights, const Bands& bands, Combine how) {
  CombinedSources result;
  for (const auto& luminaire : lights.luminaires) {
    const auto& fitting = lights.fitting_of(luminaire);
    const BandWeights weights = band_weights(fitting.spectrum, bands);
    const std::string name = combined_name(luminaire, how);
    auto found = std::find_if(result.sources.begin(), result.sources.end(), [&](const Source& source) {
      return how != Combine::each && source.name == name && source.weights == weights &&
             source.maintenance == luminaire.maintenance;
    });
    if (found == result.sources.end()) {
      Source source;
      source.name = name;
      source.group = how == Combine::all ? name : luminaire.group;
      source.weights = weights;
      source.maintenance = luminaire.maintenance;
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
  const std::size_t n_bands = sources.empty() ? 0 : sources.front().energy.size();
  for (std::size_t b = 0; b < n_bands; ++b) {
    std::vector<Account> accounts;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      if (accounts.empty() || !share_account(sources[accounts.back().first], sources[s])) accounts.push_back({s});
      const auto& energy = sources[s].energy[b];
      accounts.back().emitted_W += energy.emitted_W;
      accounts.back().open_W += energy.imbalance * energy.emitted_W;
    }
    for (const auto& account : accounts) {
      const double imbalance = account.emitted_W > 0.0 ? account.open_W / account.emitted_W : 0.0;
      if (std::abs(imbalance) > std::abs(worst.imbalance)) worst = {account.first, b, imbalance};
    }
  }
  return worst;
}

}  // namespace dim
