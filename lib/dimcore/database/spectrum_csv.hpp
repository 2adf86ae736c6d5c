#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "spectrum/curve.hpp"

namespace dim {

enum class WavelengthUnit { found, nanometre, micrometre };
enum class ValueUnit {
  found,
  fraction,
  percent,
  relative  ///< of power: any scale, at least 0
};

/// A measured spectrum: one curve a column after the wavelength's.
struct SpectrumTable {
  std::vector<std::string> names;     ///< of the columns after the first; empty texts without a header line
  std::vector<SpectralCurve> curves;  ///< 0..1 over nm, relative power on the file's own scale
  bool micrometres = false;           ///< what was found or asked for
  bool percent = false;
};

/// Reads wavelengths and reflectances or transmittances: columns separated by commas, semicolons, tabs or
/// blanks (decimal commas where the separator is another), a header line or none, lines that begin with '#'
/// passed over, rows in either order of wavelength.
///
/// Units are what the header says ("nm", "um", "µm", "%"), else found: wavelengths below 100 are micrometres,
/// a largest value above 1.5 means per cent. A largest value between 1 and 1.5 is refused unless the unit is
/// given: it may be a fraction with noise or a dark finish in per cent. Relative values, those of a light
/// source, have no unit; the noise of instruments below 0 is taken for 0.
///
/// @throws InputError  with the line: not a number, a wavelength twice, out of range, no visible part
SpectrumTable read_spectrum_csv(std::string_view text, const std::string& file_name,
                                WavelengthUnit wavelengths = WavelengthUnit::found,
                                ValueUnit values = ValueUnit::found);

}  // namespace dim
