#pragma once

#include <string>

#include "base/error.hpp"
#include "database/fitting_entry.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// A fitting entry together with its photometric file, its lumens and factors applied.
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
                                  SpectrumNames names = SpectrumNames::find);

/// The same for a photometric file that no entry names; the entry holds its file and title only.
FittingRecord fitting_record_of_file(const std::string& path, Warnings& warnings);

}  // namespace dim
