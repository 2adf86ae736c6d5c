#pragma once

#include <string>
#include <vector>

#include "base/hdf5_file.hpp"
#include "scene/lights.hpp"
#include "transport/simulate.hpp"

namespace dim {

/// Writes the relative spectrum of every source, equal ones once: `/spectra/of_source`, `/spectra/first`,
/// `/spectra/point` (docs/formats.md).
void store_spectra(Hdf5Writer& file, const Lights& lights, const Solution& solution);

/// The spectra of the sources in order; empty where the file, of an older program, has none.
/// @throws IoError  they do not hold together
std::vector<SpectralCurve> load_spectra(const Hdf5Reader& file, const std::string& path,
                                        std::size_t n_sources);

}  // namespace dim
