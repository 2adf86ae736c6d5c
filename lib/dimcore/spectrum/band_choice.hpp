#pragma once

#include <string>
#include <vector>

#include "spectrum/bands.hpp"

namespace dim {

/// How near to the 5 nm answer the light of few bands has to be.
struct BandAccuracy {
  double delta_e_2000 = 0.5;
  double luminance = 2e-3;  ///< relative
};

struct BandChoice {
  Bands bands;
  double delta_e_2000 = 0.0;  ///< largest over the light looked at
  double luminance = 0.0;     ///< largest, relative
  /// The larger of the two over what was asked for, or over what 81 bands of 5 nm reach where that is worse:
  /// up to 1 the bands are enough.
  double off = 0.0;

  bool is_enough() const { return off <= 1.0; }
};

/// "6 wavebands: colours within dE00 0.29, luminances within 0.23 %".
std::string in_words(const BandChoice& choice);

/// The fewest bands, edges halfway between the wavelengths of the tables (382.5, 387.5, ... nm), for which
/// every light of one source after one reflection from any finish, after two from any pair of them, and after
/// any even number to and fro, has the colour and luminance of a solution at every fifth nanometre
/// (physics.md section 1).
///
/// "To and fro" is the light between two parallel planes that see nothing else, r1 r2/(1 - r1 r2),
/// which is where errors of a whole room add up. Colours are compared beside a white surface lit by the
/// source alone. Sources and finishes that are equal, and grey finishes, are looked at once; many finishes
/// cost their square: 10 sources and 30 finishes take a few hundredths of a second.
///
/// Partitions are those of least squared error over the lights that were found to be off (dynamic
/// programming, repeated); one with a band less may exist that this does not find. What 81 bands of 5 nm do
/// not reach, where a reflectance changes much within 5 nm, is not asked of fewer.
///
/// @param spectra       relative power of each source, positive somewhere in the visible range
/// @param reflectances  0..1
BandChoice choose_bands(const std::vector<SpectralCurve>& spectra,
                        const std::vector<SpectralCurve>& reflectances, const BandAccuracy& accuracy = {});

/// How far the same lights are off in bands that somebody chose.
/// @param luminous_weights  of one band whose reflectances are means with these weights (luminous_weights
///                          in bands.hpp); null where they are plain means
BandChoice judge_bands(const std::vector<SpectralCurve>& spectra,
                       const std::vector<SpectralCurve>& reflectances, const Bands& bands,
                       const LatticeValues* luminous_weights = nullptr, const BandAccuracy& accuracy = {});

}  // namespace dim
