#include "database/fitting_record.hpp"

#include <filesystem>

#include "base/input_file.hpp"
#include "database/toml_reader.hpp"
#include "photometry/photometry_file.hpp"

namespace dim {

FittingRecord read_fitting_record(const std::string& entry_path, const std::string& name, Warnings& warnings,
                                  const SpectrumFinder& spectra) {
  FittingRecord record;
  record.entry = read_fitting_entry(read_text_file(entry_path, kMaxTomlBytes), entry_path, name, spectra);
  if (!is_photometric_name(record.entry.file))
    throw InputError({record.entry.file_place,
                      "'" + record.entry.file + "' is not an .ies, .ldt or .xml file",
                      foreign_format(record.entry.file).cure});
  try {
    record.photometry = read_photometric_file(record.entry.file, warnings);
  } catch (const IoError& error) {
    throw InputError({record.entry.file_place, error.what(), ""});
  }
  record.file_flux_lm = record.photometry.flux_lm;
  apply_factors(record.entry, record.photometry);
  if (record.entry.spectrum_name.empty() && !record.entry.spectrum)
    record.entry.spectrum = record.photometry.spectrum;
  return record;
}

FittingRecord fitting_record_of_file(const std::string& path, Warnings& warnings) {
  FittingRecord record;
  record.photometry = read_photometric_file(path, warnings);
  record.file_flux_lm = record.photometry.flux_lm;
  record.entry.name = std::filesystem::path(path).stem().string();
  record.entry.file = path;
  record.entry.title = record.photometry.keyword("LUMINAIRE");
  record.entry.spectrum = record.photometry.spectrum;
  return record;
}

}  // namespace dim
