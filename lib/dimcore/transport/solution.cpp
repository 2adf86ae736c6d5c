#include "transport/solution.hpp"

#include <cmath>

namespace dim {

std::vector<Vec3> Source::xyz_by_class(const ReflectanceClasses& classes) const {
  std::vector<Vec3> xyz(classes.size(), Vec3(0.0));
  for (std::size_t b = 0; b < classes.of_band.size(); ++b)
    xyz[classes.of_band[b]] +=
        kMaxEfficacy_lm_W * watts_per_lumen(b) * Vec3(weights.x[b], weights.y[b], weights.z[b]);
  return xyz;
}

namespace {

// Sources of one group and state of windows with what they emit and what of it is accounted for.
struct Account {
  std::size_t first;
  double emitted_W = 0.0, open_W = 0.0;
};

bool share_account(const Source& a, const Source& b) {
  return a.daylight && b.daylight && a.group == b.group && a.daylight->state == b.daylight->state;
}

}  // namespace

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
