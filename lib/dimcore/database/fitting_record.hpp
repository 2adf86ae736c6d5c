#pragma once

#include <string>

#include "base/error.hpp"
#include "database/fitting_entry.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// A fitting entry together with its photometric file, its lumens and factors applied. A spectrum of the
/// file's own stands in the entry where that has none.
struct FittingRecord {
  FittingEntry entry;
  Photometry photometry;
  /// Flux that the file's own intensities integrate to, before the entry's lumens and factors.
  double file_flux_lm = 0.0;

  std::optional<double> watts() const { return entry.watts ? entry.watts : photometry.watts; }
};

/// Reads an entry and the photometric file that it names.
/// @throws InputError, IoError
FittingRecord read_fitting_record(const std::string& entry_path, const std::string& name, Warnings& warnings,
                                  const SpectrumFinder& spectra = built_in_spectra());

/// The same for a photometric file that no entry names; the entry holds its file and title only.
FittingRecord fitting_record_of_file(const std::string& path, Warnings& warnings);

}  // namespace dim
