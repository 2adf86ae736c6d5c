#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/job.hpp"

namespace dim {

/// A file opened for reading, or standard input. Bytes come in order and unbuffered.
class InputFile {
 public:
  /// @param path      a file, a fifo or device by its name, or `-` for standard input
  /// @param job       its stop flag ends a wait for a pipe when a signal arrives (handler without SA_RESTART)
  /// @throws IoError      missing, not readable, a directory
  /// @throws Interrupted  as the job asks
  explicit InputFile(std::string path, const Job& job = {});
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  /// Size of a regular file opened by its name; nothing for pipes, devices and standard input.
  std::optional<std::uint64_t> size_bytes() const { return size_bytes_; }
  /// Fills `out` unless the file ends first; waits for a slow pipe.
  /// @returns         number of bytes read, less than asked only at the end of the file
  /// @throws IoError      the system's words
  /// @throws Interrupted  as the job asks
  std::size_t read(std::span<std::byte> out);

 private:
  std::string path_;
  const std::atomic<bool>* stop_ = nullptr;
  int descriptor_ = -1;
  std::optional<std::uint64_t> size_bytes_;
};

/// The whole of a text file, or of standard input for `-`, byte for byte (no decoding, no line-end changes).
///
/// @param max_bytes  the largest size accepted; memory use stays below about twice what is read
/// @throws IoError   missing, a directory, not readable, larger than `max_bytes`
std::string read_text_file(const std::string& path, std::size_t max_bytes, const Job& job = {});

/// A size in words for messages: "512 bytes", "64 MiB", "1.1 GiB".
std::string size_in_words(std::uint64_t n_bytes);

}  // namespace dim
