#include "spectrum/bands.hpp"

#include <algorithm>

#include "spectrum/tables/cie_observers.hpp"

namespace dim {

Bands Bands::uniform(int n) {
  Bands bands;
  bands.edges_nm.clear();
  for (int i = 0; i <= n; ++i)
    bands.edges_nm.push_back(kVisibleLow_nm + (kVisibleHigh_nm - kVisibleLow_nm) * i / n);
  return bands;
}

BandWeights band_weights(const SpectralCurve& spd, const Bands& bands) {
  const ObserverTables& eye = cie_1931_tables();
  const LatticeValues power = on_lattice(spd);
  BandWeights weights;
  double total = 0.0, luminous = 0.0;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    double in_band = 0.0, x = 0.0, y = 0.0, z = 0.0;
    for (std::size_t i = 0; i < kTableSize; ++i) {
      const double part = power[i] * cell_overlap_nm(i, bands.low_nm(b), bands.high_nm(b));
      in_band += part;
      x += part * eye.x[i];
      y += part * eye.y[i];
      z += part * eye.z[i];
    }
    total += in_band;
    luminous += y;
    weights.share.push_back(in_band);
    weights.x.push_back(in_band > 0.0 ? x / in_band : 0.0);
    weights.y.push_back(in_band > 0.0 ? y / in_band : 0.0);
    weights.z.push_back(in_band > 0.0 ? z / in_band : 0.0);
  }
  for (auto& share : weights.share) share /= total;
  weights.efficacy_lm_W = kMaxEfficacy_lm_W * luminous / total;
  return weights;
}

LatticeValues luminous_weights(const std::vector<SpectralCurve>& spectra, const std::vector<double>& flux_lm) {
  if (spectra.empty()) return luminous_weights({SpectralCurve(1.0)}, {1.0});
  const ObserverTables& eye = cie_1931_tables();
  const bool dark = std::all_of(flux_lm.begin(), flux_lm.end(), [](double flux) { return !(flux > 0.0); });
  LatticeValues sum{};
  double total = 0.0;
  for (std::size_t s = 0; s < spectra.size(); ++s) {
    const LatticeValues power = on_lattice(spectra[s]);
    LatticeValues seen;
    double whole = 0.0;
    for (std::size_t i = 0; i < kTableSize; ++i) {
      seen[i] = power[i] * eye.y[i] * cell_overlap_nm(i, kVisibleLow_nm, kVisibleHigh_nm);
      whole += seen[i];
    }
    const double weight = dark ? 1.0 : flux_lm[s];
    for (std::size_t i = 0; i < kTableSize; ++i) sum[i] += weight * seen[i] / whole;
    total += weight;
  }
  for (double& value : sum) value /= total;
  return sum;
}

}  // namespace dim
