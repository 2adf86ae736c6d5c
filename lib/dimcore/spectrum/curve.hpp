#pragma once

#include <utility>
#include <vector>

namespace dim {

/// A quantity over wavelength: linear between its points, constant beyond the first and last.
/// One point means the same value everywhere ("grey").
class SpectralCurve {
 public:
  SpectralCurve() = default;
  explicit SpectralCurve(double value) : points_{{555.0, value}} {}
  /// @param points {wavelength nm, value}, at least one, wavelengths strictly ascending (callers check input)
  explicit SpectralCurve(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {}

  const std::vector<std::pair<double, double>>& points() const { return points_; }
  double at(double wavelength_nm) const;
  /// True where every value is the same.
  bool is_flat() const;
  double max() const;
  double min() const;
  /// Plain mean over [low_nm, high_nm], exact for the piecewise-linear curve.
  double mean(double low_nm, double high_nm) const;
  /// Integral over [low_nm, high_nm], exact for the piecewise-linear curve.
  double integral(double low_nm, double high_nm) const;

 private:
  std::vector<std::pair<double, double>> points_{{555.0, 0.0}};
};

}  // namespace dim
