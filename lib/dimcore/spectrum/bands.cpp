#include "spectrum/bands.hpp"

#include <algorithm>

#include "spectrum/observer.hpp"

namespace dim {

Bands Bands::uniform(int n) {
  Bands bands;
  bands.edges_nm.clear();
  for (int i = 0; i <= n; ++i)
    bands.edges_nm.push_back(kVisibleLow_nm + (kVisibleHigh_nm - kVisibleLow_nm) * i / n);
  return bands;
}

double integral_of_product(const SpectralCurve& a, const SpectralCurve& b, double low_nm, double high_nm) {
  std::vector<double> knots{low_nm, high_nm};
  for (const auto* curve : {&a, &b}) {
    for (const auto& [nm, value] : curve->points()) {
      if (nm > low_nm && nm < high_nm) knots.push_back(nm);
    }
  }
  std::sort(knots.begin(), knots.end());
  double sum = 0.0;
  // Between knots the product is a parabola, which Simpson's rule integrates exactly.
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double l = knots[i], h = knots[i + 1], m = (l + h) / 2.0;
    sum += (h - l) / 6.0 * (a.at(l) * b.at(l) + 4.0 * a.at(m) * b.at(m) + a.at(h) * b.at(h));
  }
  return sum;
}

BandWeights band_weights(const SpectralCurve& spd, const Bands& bands) {
  const Observer& eye = cie_1931_observer();
  const double total = spd.integral(kVisibleLow_nm, kVisibleHigh_nm);
  BandWeights weights;
  weights.efficacy_lm_W =
      kMaxEfficacy_lm_W * integral_of_product(eye.y, spd, kVisibleLow_nm, kVisibleHigh_nm) / total;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const double low = bands.low_nm(b), high = bands.high_nm(b), in_band = spd.integral(low, high);
    weights.share.push_back(in_band / total);
    const auto response = [&](const SpectralCurve& function) {
      return in_band > 0.0 ? integral_of_product(function, spd, low, high) / in_band : 0.0;
    };
    weights.x.push_back(response(eye.x));
    weights.y.push_back(response(eye.y));
    weights.z.push_back(response(eye.z));
  }
  return weights;
}

}  // namespace dim
