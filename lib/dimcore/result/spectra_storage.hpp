#pragma once

#include <string>
#include <vector>

#include "base/hdf5_file.hpp"
#include "result/content.hpp"

namespace dim {

/// Writes the relative spectrum of every source, equal ones once: `/spectra/of_source`, `/spectra/first`,
/// `/spectra/point` (docs/formats.md).
void store_spectra(Hdf5Writer& file, const std::vector<ShownSpectrum>& spectra);

/// Fills the curves of the sources' spectra.
/// @throws IoError  they do not hold together
void load_spectra(const Hdf5Reader& file, const std::string& path, std::vector<ShownSpectrum>& spectra);

}  // namespace dim
