#pragma once

#include "base/file_layout.hpp"
#include "base/hdf5_file.hpp"
#include "scene/zone.hpp"

namespace dim {

/// What the file holds of a zone.
const FileSchema& zone_schema();

/// Puts a zone into a file under `/zone`, whole: what `load_zone` gives back is equal to the last bit.
/// Layout: docs/formats.md.
void store_zone(Hdf5Writer& file, const Zone& zone);

/// @throws IoError  when the file's zone is not of this layout or does not hold together
Zone load_zone(const Hdf5Reader& file, const std::string& path);

}  // namespace dim
