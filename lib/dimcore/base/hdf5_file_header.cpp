#include "base/hdf5_file_header.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <new>
#include <optional>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr std::string_view kMagic = "DIM file\n";
constexpr std::string_view kSeal = "head ";
constexpr std::size_t kSealLine_bytes = 5 + 16 + 1;
constexpr std::size_t kMaxKindLength = 16;
constexpr std::size_t kHashDigits = 32;

std::string seal_line(std::string_view text) {
  return fmt::format("{}{:016x}\n", kSeal, XXH3_64bits(text.data(), text.size()));
}

bool is_kind(std::string_view kind) {
  return !kind.empty() && kind.size() <= kMaxKindLength && std::ranges::all_of(kind, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// The lines of the header without the seal, or nothing when the seal does not fit the bytes.
std::optional<std::string_view> sealed_text(std::string_view block) {
  const std::size_t last = block.find_last_not_of('\0');
  if (last == std::string_view::npos || last + 1 < kSealLine_bytes) return std::nullopt;
  const std::string_view text = block.substr(0, last + 1 - kSealLine_bytes);
  if (block.substr(text.size(), kSealLine_bytes) != seal_line(text)) return std::nullopt;
  return text;
}

/// The value on the line "name value", empty when there is none.
std::string_view field(std::string_view text, std::string_view name) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.size() > name.size() && line.starts_with(name) && line[name.size()] == ' ') {
      return line.substr(name.size() + 1);
    }
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return {};
}

template <class Number>
std::optional<Number> number(std::string_view digits) {
  Number value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || stop != end || value < 1) return std::nullopt;
  return value;
}

bool is_text(std::string_view bytes) {
  return std::ranges::all_of(bytes, [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code >= 0x20 || c == '\n' || c == '\r' || c == '\t' || c == '\f';
  });
}

/// What a file without DIM's header is, as far as its first bytes tell.
std::string foreign_in_words(std::string_view start) {
  if (start.starts_with("\x89HDF\r\n\x1a\n")) return "is an HDF5 file of another program";
  if (is_text(start)) return "is a text file";
  return "is not a DIM file";
}

[[noreturn]] void throw_altered(const std::string& path) {
  throw IoError(path, "is altered or damaged: its header does not match its own checksum");
}

std::string other_version(const FileHeader& header, FormatVersions versions) {
  const bool older = header.version < versions.oldest;
  const std::string by = header.program.empty() ? "" : " by DIM " + header.program;
  return fmt::format("written{} in format {}, this program reads {}; {}", by, header.version,
                     in_words(versions),
                     older ? "make it again with this " + maker_of(header.kind)
                           : "use that version of DIM or a newer one");
}

}  // namespace

std::array<char, kHeader_bytes> make_header(const FileHeader& header) {
  if (!is_kind(header.kind) || header.version < 1 || header.body_hash.size() != kHashDigits) {
    throw InternalError(fmt::format("no header can say kind '{}', version {}, hash '{}'", header.kind,
                                    header.version, header.body_hash));
  }
  std::string text = fmt::format("{}kind {}\nversion {}\nsize {}\nxxh128 {}\n", kMagic, header.kind,
                                 header.version, header.file_bytes, header.body_hash);
  if (!header.program.empty()) text += "program " + header.program + "\n";
  text += seal_line(text);
  std::array<char, kHeader_bytes> block = {};
  std::ranges::copy(text, block.begin());
  return block;
}

FileHeader parse_header(const std::string& path, std::span<const char> start, std::string_view expected_kind,
                        FormatVersions versions) {
  const std::string_view block(start.data(), start.size());
  const std::string expected = "; expected " + kind_in_words(expected_kind);
  if (block.empty()) throw IoError(path, "is empty" + expected);
  if (!block.starts_with(kMagic.substr(0, block.size()))) {
    throw IoError(path, foreign_in_words(block) + expected);
  }
  if (block.size() < kHeader_bytes) {
    throw IoError(path,
                  fmt::format("is cut short: holds {} of at least {} bytes", block.size(), kHeader_bytes));
  }

  const auto text = sealed_text(block);
  if (!text) throw_altered(path);
  FileHeader header;
  header.kind = field(*text, "kind");
  if (header.kind != expected_kind)
    throw IoError(path, "is " + kind_in_words(header.kind) + expected + ", which " + maker_of(expected_kind) + " makes");
  const auto version = number<int>(field(*text, "version"));
  if (!version) throw_altered(path);
  header.version = *version;
  header.program = field(*text, "program");
  if (header.version < versions.oldest || header.version > versions.newest)
    throw IoError(path, other_version(header, versions));
  const auto size = number<std::uint64_t>(field(*text, "size"));
  header.body_hash = field(*text, "xxh128");
  if (!size || *size <= kHeader_bytes || header.body_hash.size() != kHashDigits) throw_altered(path);
  header.file_bytes = *size;
  return header;
}

std::string kind_in_words(std::string_view kind) {
  if (kind == "rays") return "a ray network (.rays)";
  if (kind == "lum") return "a luminance database (.lum)";
  return fmt::format("a DIM file of kind '{}'", kind);
}

std::string maker_of(std::string_view kind) { return kind == "rays" ? "dimdis" : "dimray"; }

std::string in_words(FormatVersions versions) {
  return versions.oldest == versions.newest ? std::to_string(versions.newest)
                                            : fmt::format("{}..{}", versions.oldest, versions.newest);
}

BodyHash::BodyHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_));
}

BodyHash::~BodyHash() { XXH3_freeState(static_cast<XXH3_state_t*>(state_)); }

void BodyHash::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), bytes.data(), bytes.size());
}

std::string BodyHash::hex() const {
  XXH128_canonical_t digest;
  XXH128_canonicalFromHash(&digest, XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state_)));
  std::string digits;
  for (const unsigned char byte : digest.digest) digits += fmt::format("{:02x}", byte);
  return digits;
}

}  // namespace dim
