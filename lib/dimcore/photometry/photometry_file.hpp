#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "photometry/ies.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// Whether a name ends as photometric files do: .ies or .ldt, in either case.
bool is_photometric_name(const std::string& name);

/// Reads a photometric file of either format, told apart by its contents: an LM-63 file has a line TILT=, an
/// EULUMDAT file (read_eulumdat) has none.
/// @param resolver  see read_ies
/// @throws InputError
Photometry read_photometry(std::string_view bytes, const std::string& file_name, Warnings& warnings,
                           const TiltResolver& resolver = {});

/// The same from disk, or from standard input for "-"; TILT=name is looked for beside the file.
/// @throws IoError  the file cannot be read
Photometry read_photometric_file(const std::string& path, Warnings& warnings);

}  // namespace dim
