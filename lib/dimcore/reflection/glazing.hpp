#pragma once

#include <array>

#include "reflection/finish.hpp"

namespace dim {

/// A pane with parallel faces, light thrown to and fro inside added up without interference: what it lets pass
/// and what it reflects by angle, unpolarised. Found from its index and its transmittance at normal incidence.
///
/// For each polarisation, with face reflectance r and a the share that survives one way through the pane:
/// tau = (1-r)^2 a / (1 - r^2 a^2), rho = r (1 + tau a).
class Slab {
 public:
  /// @param ior             >= 1
  /// @param normal_transmittance  0..1. More than faces of that index let pass, (1-r)/(1+r), is taken as
  ///                        that of a clear pane with anti-reflection coatings: of the index that lets it pass
  Slab(double ior, double normal_transmittance);

  /// @param cos_incidence 0..1
  double transmittance(double cos_incidence) const;
  double reflectance(double cos_incidence) const;
  /// Of light from all sides evenly: the mean weighted with the cosine.
  double hemispherical_reflectance() const;

 private:
  double survives(double cos_incidence) const;

  double ior_;
  double inside_;  // share that survives one way through at normal incidence
};

/// How a glazing passes light straight on, by angle of incidence, in one waveband. The part it scatters is
/// left to `ScatteringPane`.
class Transmission {
 public:
  Transmission() = default;
  /// @param normal_transmittance  of the band (BandReflection::transmittance)
  Transmission(const Finish& finish, double normal_transmittance);

  /// 0..1. @param cos_incidence  0..1
  double at(double cos_incidence) const {
    const double x = cos_incidence * kSteps;
    const auto i = static_cast<std::size_t>(x < kSteps - 1 ? x : kSteps - 1);
    const double share = x - static_cast<double>(i);
    return (1.0 - share) * values_[i] + share * values_[i + 1];
  }
  bool is_black() const { return values_[kSteps] == 0.0 && values_[kSteps / 2] == 0.0; }
  bool operator==(const Transmission&) const = default;

 private:
  static constexpr int kSteps = 1024;  // of the cosine; linear between: good to 1e-6
  std::array<double, kSteps + 1> values_{};
};

/// What a glazing without a stated reflectance reflects of light from all sides: the slab's for glass and the
/// table (whose transmittance at normal incidence it shares), nothing for a constant.
SpectralCurve own_reflectance(const Finish& finish);

}  // namespace dim
