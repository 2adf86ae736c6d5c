#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The header of DIM's binary files, kept in the HDF5 user block: 512 bytes of printable text and zeros that
/// say what the file is, how long it is and what its bytes hash to. docs/formats-container.md is its
/// specification.
namespace dim {

inline constexpr std::size_t kHeader_bytes = 512;

struct FileHeader {
  std::string kind;              ///< "rays", "lum": 1 to 16 of a-z, 0-9 and '-'
  int version = 0;               ///< of the format of this kind, >= 1
  std::uint64_t file_bytes = 0;  ///< the whole file, this header included
  std::string body_hash;         ///< XXH3 128-bit of everything after the header, 32 lower-case hex digits
  std::string program = {};      ///< version of DIM that wrote it; empty in files of the first versions
};

/// The formats of a kind that a program reads.
struct FormatVersions {
  int oldest = 1;
  int newest = 1;
};
/// "2", or "1..2".
std::string in_words(FormatVersions versions);

/// The 512 bytes of the header.
/// @throws InternalError  a kind, version or hash that the format cannot hold
std::array<char, kHeader_bytes> make_header(const FileHeader& header);

/// Reads a header and checks it to the last bit, so that any change of any of the 512 bytes is refused.
///
/// @param path           for messages
/// @param start          the first 512 bytes of the file, or all of a shorter one
/// @param expected_kind  what the caller reads
/// @param max_version    the newest version of it that the caller reads
/// @throws IoError  one line that says which: empty, foreign, cut short, altered, another kind, newer version
FileHeader parse_header(const std::string& path, std::span<const char> start, std::string_view expected_kind,
                        FormatVersions versions);

/// A kind in words: "a ray network (.rays)".
std::string kind_in_words(std::string_view kind);
/// The program that writes files of a kind: "dimdis".
std::string maker_of(std::string_view kind);

/// XXH3 128-bit of bytes that come piece by piece; the digits are those of `xxh128sum`.
class BodyHash {
 public:
  BodyHash();
  ~BodyHash();
  BodyHash(const BodyHash&) = delete;
  BodyHash& operator=(const BodyHash&) = delete;
  void add(std::span<const std::byte> bytes);
  std::string hex() const;

 private:
  void* state_ = nullptr;
};

}  // namespace dim
