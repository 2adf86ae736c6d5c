#pragma once

// Shared by parts of the reader, and by nothing else.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/hdf5_file_header.hpp"
#include "base/hdf5_file_internal.hpp"
#include "base/input_file.hpp"

namespace dim {

/// Memory that grows without being copied where the system can move pages.
struct GrowingMemory {
  struct Free {
    void operator()(std::byte* owned) const { std::free(owned); }
  };
  std::unique_ptr<std::byte[], Free> bytes;
  std::size_t capacity = 0;
};

/// A file whose every byte has been checked: still open on the disk, or held in memory.
struct VerifiedFile {
  FileHeader header;
  std::unique_ptr<InputFile> on_disk;  ///< empty for a pipe
  GrowingMemory in_memory;             ///< empty for a regular file
};

/// Reads all of the file and checks it.
/// @throws IoError as Hdf5Reader
VerifiedFile verify_file(const std::string& path, const std::string& expected_kind, FormatVersions versions,
                         const Job& job);

/// Opens what was checked, and not what may have got its name since.
hdf5::Handle open_verified(const std::string& path, VerifiedFile& content);

}  // namespace dim
