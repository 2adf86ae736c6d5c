#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "database/search.hpp"
#include "spectrum/curve.hpp"

namespace dim {

inline constexpr const char* kSpectra = "spectra";

/// A database entry `spectra/NAME.toml`: the spectrum of a light source.
struct SpectrumEntry {
  std::string name, title;
  SpectralCurve power{1.0};  ///< relative, at least 0, with light between 380 and 780 nm
  std::string source, licence, note;
};

/// Reads the text of an entry: `power` (required; [[nm, value], ...]), `title`, `source`, `licence`, `note`;
/// `dim = "spectrum/1"` may begin it.
/// @throws InputError with every problem of the entry
SpectrumEntry read_spectrum_entry(std::string_view text, const std::string& file, const std::string& name);

/// The TOML of such an entry.
std::string spectrum_entry_text(const SpectrumEntry& entry);

/// A light source's spectrum as an instrument or a maker writes it: columns of wavelength and values (see
/// read_spectrum_csv), or XML of IES TM-27 (.spdx) or of TM-33 with a spectrum. Beyond the wavelengths listed
/// there is no light.
/// @param column  of the values, counted from 0; columns of text only
/// @throws InputError  with the line
SpectrumEntry read_lamp_spectrum(std::string_view text, const std::string& file, std::size_t column = 0);

/// Gives the spectrum of a name.
using SpectrumFinder = std::function<SpectralCurve(const std::string& name)>;

/// Finds the spectra that DIM knows by itself (find_spectrum).
SpectrumFinder built_in_spectra();

/// Finds the spectra that DIM knows by itself (find_spectrum), then those of the database's folders.
/// The finder throws InputError for a name that neither has, with the nearest of both.
/// @param search  must outlive the finder
SpectrumFinder spectrum_finder(const DatabaseSearch& search);

}  // namespace dim
