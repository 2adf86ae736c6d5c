#pragma once

#include <vector>

#include "network/cells.hpp"
#include "result/luminous.hpp"
#include "spectrum/band_choice.hpp"
#include "spectrum/rendering.hpp"
#include "spectrum/white.hpp"

namespace dim {

/// What a light is like. NaN where it is not defined: chromaticity without light, temperature far from white,
/// Ra without a temperature; and temperature, Ra and melanopic EDI of light whose spectrum is not known well
/// enough (LightColours::left_out).
struct LightColour {
  double illuminance_lx = 0.0;
  Vec2 xy{0.0};  ///< CIE 1931
  Vec2 uv{0.0};  ///< CIE 1976 u', v'
  WhitePoint white;
  double ra = 0.0;  ///< CIE 13.3
  double melanopic_edi_lx = 0.0;
};

/// The light that falls on measuring points and surfaces, by its spectrum: within each band that of the
/// source, changed as much as the band was on its way.
class LightColours {
 public:
  explicit LightColours(const LuminanceDatabase& database);

  /// Why colour temperature, Ra and melanopic EDI are left out of some figures of a mix: sources whose
  /// spectrum nobody stated, too few bands for the finishes that colour the light.
  Warnings left_out(const Mix& mix) const;

  /// Of each measuring point. [n_points]
  std::vector<LightColour> at_points(const Mix& mix) const;
  /// Of each surface, its cells weighted by area. [n_surfaces]
  std::vector<LightColour> on_surfaces(const Cells& cells, const Mix& mix) const;

 private:
  // Sum over sources and classes of transfer times response. `read(s)` gives [n_classes, n] transfer, lx.
  template <typename Read>
  std::vector<LightColour> mixed(std::size_t n, const Mix& mix, const Read& read) const;
  LightColour figures(const LightResponses& light, bool known) const;
  bool unknown(const Mix& mix, std::size_t source) const;

  const LuminanceDatabase& database_;
  BandChoice bands_;                    // how far off they are
  std::vector<LightResponses> per_lm_;  // [source, class], of 1 lm of the source sent through the class
};

}  // namespace dim
