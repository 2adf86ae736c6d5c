#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "database/search.hpp"
#include "database/spectrum_entry.hpp"
#include "photometry/photometry.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// A database entry `fittings/NAME.toml`: names the photometric file and says what that file does not.
struct FittingEntry {
  std::string name;
  std::string title;
  std::string file;                 ///< path of the .ies or .ldt, made relative to the entry's own folder
  std::optional<double> watts;      ///< > 0
  std::optional<double> lumens;     ///< luminaire flux that the intensities are scaled to, > 0
  double lamp_factor = 1.0;         ///< flux of the lamps used over that of the lamps measured, > 0
  double maintenance_factor = 1.0;  ///< flux in use over flux when new, 0..1, above 0
  std::optional<SpectralCurve> spectrum;  ///< relative
  std::string spectrum_name;              ///< where the entry names it instead of writing it out
  std::string source;
  std::string licence;
  Place file_place;  ///< of the photometric file's name in the entry

  /// Flux in use over that of the fitting as new: both factors.
  double in_use_factor() const { return lamp_factor * maintenance_factor; }
};

/// Reads the text of an entry: `file` (required), `watts`, `lumens`, `lamp_factor`, `maintenance_factor`,
/// `spectrum` ([[nm, value], ...] or a name that the finder knows), `source`, `licence`,
/// `title`, `note`; `dim = "fitting/1"` may begin it.
/// @param spectra  without one, a spectrum's name is kept and not looked up
/// @throws InputError with every problem of the entry
FittingEntry read_fitting_entry(std::string_view text, const std::string& file, const std::string& name,
                                const SpectrumFinder& spectra = built_in_spectra());

/// Scales intensities, flux and largest intensity.
void scale(Photometry& photometry, double factor);
/// To the entry's lumens: the fitting as new.
void apply_lumens(const FittingEntry& entry, Photometry& photometry);
/// To the entry's lumens, then by its lamp and maintenance factors: the fitting in use.
void apply_factors(const FittingEntry& entry, Photometry& photometry);

class TomlTable;

/// A `spectrum` key: a curve, or a name (see the finder), which is left in `spectrum_name` as well. Unknown
/// names and curves without any light are reported.
void read_spectrum_key(const TomlTable& table, std::optional<SpectralCurve>& spectrum,
                       std::string& spectrum_name, const SpectrumFinder& spectra);

}  // namespace dim
