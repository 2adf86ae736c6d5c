#include "database/fitting_record.hpp"

#include <filesystem>

#include "base/input_file.hpp"
#include "database/toml_reader.hpp"
#include "photometry/photometry_file.hpp"

namespace dim {

FittingRecord read_fitting_record(const std::string& entry_path, const std::string& name, Warnings& warnings,
                                  SpectrumNames names) {
  FittingRecord record;
  record.entry = read_fitting_entry(read_text_file(entry_path, kMaxTomlBytes), entry_path, name, names);
  if (!is_photometric_name(record.entry.file))
    throw InputError(
        {record.entry.file_place, "'" + record.entry.file + "' is not an .ies or .ldt file", ""});
  try {
    record.photometry = read_photometric_file(record.entry.file, warnings);
  } catch (const IoError& error) {
    throw InputError({record.entry.file_place, error.what(), ""});
  }
  record.file_flux_lm = record.photometry.flux_lm;
  apply_factors(record.entry, record.photometry);
  return record;
}

FittingRecord fitting_record_of_file(const std::string& path, Warnings& warnings) {
  FittingRecord record;
  record.photometry = read_photometric_file(path, warnings);
  record.file_flux_lm = record.photometry.flux_lm;
  record.entry.name = std::filesystem::path(path).stem().string();
  record.entry.file = path;
  record.entry.title = record.photometry.keyword("LUMINAIRE");
  return record;
}

}  // namespace dim
