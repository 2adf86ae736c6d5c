#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "photometry/ies.hpp"
#include "photometry/photometry.hpp"

namespace dim {

/// Whether a name ends as photometric files do: .ies, .ldt or .xml (TM-33), in either case.
bool is_photometric_name(const std::string& name);

/// What a photometric file of another kind is, by its name, and where to get one that can be read; empty
/// where the name says nothing. "a GLDF container" for .gldf.
struct ForeignFormat {
  std::string what;
  std::string cure;
};
ForeignFormat foreign_format(const std::string& name);

/// Reads a photometric file of any format, told apart by its contents: a TM-33 file is XML, an LM-63 file has
/// a line TILT=, an EULUMDAT file (read_eulumdat) has none.
/// @param resolver  see read_ies
/// @throws InputError
Photometry read_photometry(std::string_view bytes, const std::string& file_name, Warnings& warnings,
                           const TiltResolver& resolver = {});

/// The same from disk, or from standard input for "-"; TILT=name is looked for beside the file.
/// @throws IoError  the file cannot be read
Photometry read_photometric_file(const std::string& path, Warnings& warnings);

}  // namespace dim
