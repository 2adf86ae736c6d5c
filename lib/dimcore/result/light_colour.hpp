#pragma once

#include <vector>

#include "network/cells.hpp"
#include "result/luminous.hpp"
#include "spectrum/rendering.hpp"
#include "spectrum/white.hpp"

namespace dim {

/// What a light is like. NaN where it is not defined: chromaticity without light, temperature far from white,
/// Ra without a temperature, Ra and melanopic EDI where the database holds no spectra.
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

  /// False for files of programs that did not store spectra.
  bool has_spectra() const { return has_spectra_; }

  /// Of each measuring point. [n_points]
  std::vector<LightColour> at_points(const Mix& mix) const;
  /// Of each surface, its cells weighted by area. [n_surfaces]
  std::vector<LightColour> on_surfaces(const Cells& cells, const Mix& mix) const;

 private:
  // Sum over sources and bands of irradiance times response. `read(s)` gives [n_bands, n] irradiances, W/m2.
  template <typename Read>
  std::vector<LightColour> mixed(std::size_t n, const Mix& mix, const Read& read) const;
  LightColour figures(const LightResponses& light) const;

  const LuminanceDatabase& database_;
  bool has_spectra_;
  std::vector<LightResponses> per_W_;  // [source, band], of 1 W in the band
};

}  // namespace dim
