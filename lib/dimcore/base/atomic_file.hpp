#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/job.hpp"

namespace dim {

/// An output file that appears whole or not at all.
///
/// The bytes go to a hidden temporary in the same folder, which `commit` makes durable (fsync) and renames
/// over the target. Without a commit — an error, an interrupt that unwinds the stack — the destructor
/// removes the temporary and the previous file stays as it was; after a kill -9 only the temporary remains, and the next that
/// writes the same file sweeps it, once it is a minute old.
///
/// * `-` is standard output, and a target that exists and is no regular file (/dev/null, a fifo) is written
///   directly: their bytes cannot be taken back.
/// * An existing file keeps its permission bits, and its owner where the system allows it; a symbolic link
///   stays and its target is replaced; other hard links keep the old contents. A file without write
///   permission is refused, although a rename could replace it.
/// * A program that wants errors instead of signals ignores SIGPIPE (reader gone) and SIGXFSZ (size limit).
class AtomicFile {
 public:
  /// Opens the temporary, so that a long computation can learn beforehand that its result cannot be written.
  /// @param job       its stop flag ends the writing
  /// @throws IoError  a directory, no such folder, no permission
  explicit AtomicFile(std::string path, const Job& job = {});
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes.
  /// @throws IoError      disk full, quota, pipe closed, with the system's words; the temporary is removed
  /// @throws Interrupted  as the job asks
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  /// Where a library that writes by name is to put its bytes, in place of `write`; empty where they go straight to a
  /// pipe or device.
  const std::string& temporary() const { return temporary_; }

  /// Puts the file in its place. To be called once, last.
  /// @throws IoError  as write
  void commit();

 private:
  void open_direct();
  void open_temporary(std::optional<mode_t> permissions);
  void take_after(const struct stat& existing) noexcept;
  void abandon() noexcept;
  [[noreturn]] void fail(int error);

  std::string path_;       ///< as the caller wrote it, for messages
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< empty when written directly
  const std::atomic<bool>* stop_ = nullptr;
  int descriptor_ = -1;
};

/// Writes the parts, one after the other, as the whole of a file: AtomicFile in one call.
/// @throws IoError
void write_file(const std::string& path, std::span<const std::span<const std::byte>> parts,
                const Job& job = {});
void write_file(const std::string& path, std::string_view text, const Job& job = {});

}  // namespace dim
