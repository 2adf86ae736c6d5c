#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "database/search.hpp"
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
};

/// Whether a spectrum's name is looked up, which takes milliseconds, or only kept.
enum class SpectrumNames { find, keep };

/// Reads the text of an entry: `file` (required), `watts`, `lumens`, `lamp_factor`, `maintenance_factor`,
/// `spectrum` ([[nm, value], ...] or a name that find_spectrum knows), `source`, `licence`,
/// `title`, `note`; `dim = "fitting/1"` may begin it.
/// @throws InputError with every problem of the entry
FittingEntry read_fitting_entry(std::string_view text, const std::string& file, const std::string& name,
                                SpectrumNames names = SpectrumNames::find);

/// Scales intensities, flux and largest intensity to the entry's lumens, then by its factors.
void apply_factors(const FittingEntry& entry, Photometry& photometry);

class TomlTable;

/// A `spectrum` key: a curve, or a name (see find_spectrum), which is left in `spectrum_name` as well.
/// Unknown names and curves without any light are reported.
void read_spectrum_key(const TomlTable& table, std::optional<SpectralCurve>& spectrum,
                       std::string& spectrum_name, SpectrumNames names = SpectrumNames::find);

}  // namespace dim
