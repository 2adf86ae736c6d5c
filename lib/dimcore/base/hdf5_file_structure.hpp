#pragma once

// Shared by parts of the reader, and by nothing else.

#include <cstdint>
#include <string>

#include "base/hdf5_file_internal.hpp"

namespace dim::hdf5 {

/// Refuses what DIM never writes, before anything of it is read: links that lead elsewhere, so that no other
/// file is opened; an object under two names; and datasets that are not contiguous, uncompressed and wholly
/// inside this file, so that nothing read of it is larger than the file.
/// @throws IoError  naming the link or dataset
void check_structure(const Handle& file, const std::string& path, std::uint64_t file_bytes);

}  // namespace dim::hdf5
