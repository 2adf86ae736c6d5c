#include "spectrum/curve.hpp"

#include <algorithm>

namespace dim {

double SpectralCurve::at(double wavelength_nm) const {
  const auto above = std::lower_bound(points_.begin(), points_.end(), wavelength_nm,
                                      [](const auto& point, double nm) { return point.first < nm; });
  if (above == points_.begin()) return points_.front().second;
  if (above == points_.end()) return points_.back().second;
  const auto below = above - 1;
  const double t = (wavelength_nm - below->first) / (above->first - below->first);
  return below->second + t * (above->second - below->second);
}

bool SpectralCurve::is_flat() const { return min() == max(); }

double SpectralCurve::max() const {
  return std::max_element(points_.begin(), points_.end(),
                          [](auto& a, auto& b) { return a.second < b.second; })
      ->second;
}

double SpectralCurve::min() const {
  return std::min_element(points_.begin(), points_.end(),
                          [](auto& a, auto& b) { return a.second < b.second; })
      ->second;
}

double SpectralCurve::integral(double low_nm, double high_nm) const {
  double sum = 0.0;
  double nm = low_nm, value = at(low_nm);
  for (const auto& [next_nm, next_value] : points_) {
    if (next_nm <= low_nm) continue;
    if (next_nm >= high_nm) break;
    sum += (next_nm - nm) * (value + next_value) / 2.0;
    nm = next_nm;
    value = next_value;
  }
  return sum + (high_nm - nm) * (value + at(high_nm)) / 2.0;
}

double SpectralCurve::mean(double low_nm, double high_nm) const {
  if (is_flat()) return points_.front().second;
  return integral(low_nm, high_nm) / (high_nm - low_nm);
}

}  // namespace dim
