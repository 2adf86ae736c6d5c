#pragma once

#include <string>
#include <vector>

#include "spectrum/curve.hpp"
#include "spectrum/lattice.hpp"

namespace dim {

/// Luminous efficacy of monochromatic radiation at 540 THz, lm/W.
inline constexpr double kMaxEfficacy_lm_W = 683.0;

/// Wavebands: band b reaches from edges_nm[b] to edges_nm[b + 1].
struct Bands {
  std::vector<double> edges_nm{kVisibleLow_nm, kVisibleHigh_nm};

  std::size_t size() const { return edges_nm.size() - 1; }
  double low_nm(std::size_t b) const { return edges_nm[b]; }
  double high_nm(std::size_t b) const { return edges_nm[b + 1]; }

  /// n equal bands over the visible range. @param n >= 1
  static Bands uniform(int n);
};

/// How a light source's radiation divides over bands, and what an eye makes of each band. physics.md
/// section 1.
///
/// The weights are per source and band, so that direct illuminance and grey rooms are exact with one band.
struct BandWeights {
  double efficacy_lm_W = 0.0;   ///< K = 683 int V S / int S over the visible range
  std::vector<double> share;    ///< F_b = int_b S / int_vis S; sums to 1
  std::vector<double> x, y, z;  ///< int_b of the observer's function times S, over int_b S; y is v_b

  bool operator==(const BandWeights&) const = default;
};

/// Weights of a relative spectral power distribution: sums every 5 nm, as CIE 15 forms tristimulus values; a
/// band takes from each wavelength the part of its 5 nm that lies in the band.
/// @param spd  any scale, >= 0, positive somewhere in the visible range (callers check input)
BandWeights band_weights(const SpectralCurve& spd, const Bands& bands);

/// What the eye makes of the light of several lamps, by wavelength: V S of each, weighted by its luminous
/// flux; sums every 5 nm, adds up to 1. Means of reflectances with these weights are luminous reflectances
/// under that light.
/// @param flux_lm  one for each spectrum; where none has any, all weigh alike. Without spectra: equal energy
LatticeValues luminous_weights(const std::vector<SpectralCurve>& spectra, const std::vector<double>& flux_lm);

}  // namespace dim
