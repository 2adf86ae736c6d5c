#include "base/hdf5_file_verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace dim {
namespace {

// Small enough to be hashed while still in the cache.
constexpr std::size_t kPiece_bytes = std::size_t{256} << 10;
constexpr std::size_t kFirstMemory_bytes = std::size_t{4} << 20;

void check_length(const std::string& path, std::uint64_t found, std::uint64_t expected) {
  if (found < expected) {
    throw IoError(path, fmt::format("is cut short: holds {} of {} bytes", found, expected));
  }
  if (found > expected) throw IoError(path, fmt::format("is altered: goes on after its {} bytes", expected));
}

void grow(GrowingMemory& memory, std::size_t capacity, const std::string& path) {
  void* moved = std::realloc(memory.bytes.get(), capacity);
  if (!moved)
    throw LimitError(path + ": not enough memory to hold " + size_in_words(capacity) + " from a pipe");
  static_cast<void>(memory.bytes.release());
  memory.bytes.reset(static_cast<std::byte*>(moved));
  memory.capacity = capacity;
}

std::uint64_t hash_from_disk(InputFile& file, BodyHash& hash) {
  std::vector<std::byte> piece(kPiece_bytes);
  std::uint64_t n_bytes = kHeader_bytes;
  while (const std::size_t n = file.read(piece)) {
    hash.add(std::span(piece).first(n));
    n_bytes += n;
  }
  return n_bytes;
}

/// The length in the header is believed only as far as bytes have come, so that it cannot ask for absurd
/// memory.
std::uint64_t hash_into_memory(InputFile& file, std::span<const char> start, std::uint64_t expected_bytes,
                               GrowingMemory& memory, BodyHash& hash) {
  const auto size = static_cast<std::size_t>(expected_bytes);
  grow(memory, std::min(size, kFirstMemory_bytes), file.path());
  std::ranges::copy(std::as_bytes(start), memory.bytes.get());
  std::size_t n_bytes = start.size();
  while (n_bytes < size) {
    if (n_bytes == memory.capacity) grow(memory, std::min(size, 2 * memory.capacity), file.path());
    const std::span<std::byte> piece(memory.bytes.get() + n_bytes,
                                     std::min(memory.capacity - n_bytes, kPiece_bytes));
    const std::size_t n = file.read(piece);
    hash.add(piece.first(n));
    n_bytes += n;
    if (n < piece.size()) return n_bytes;
  }
  std::byte beyond = {};
  return n_bytes + file.read({&beyond, 1});
}

/// HDF5 would copy an image twice; these hand it our memory, which it may only read.
H5FD_file_image_callbacks_t shared_memory(GrowingMemory& memory) {
  H5FD_file_image_callbacks_t calls = {};
  calls.udata = memory.bytes.get();
  calls.image_malloc = [](std::size_t, H5FD_file_image_op_t, void* image) { return image; };
  calls.image_memcpy = [](void* to, const void* from, std::size_t, H5FD_file_image_op_t, void*) -> void* {
    return to == from ? to : nullptr;
  };
  calls.image_realloc = [](void*, std::size_t, H5FD_file_image_op_t, void*) -> void* { return nullptr; };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* image) { return image; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  return calls;
}

hdf5::Handle open_memory(VerifiedFile& content) {
  const hdf5::Handle access = hdf5::memory_access(kPiece_bytes);
  H5FD_file_image_callbacks_t calls = shared_memory(content.in_memory);
  H5Pset_file_image_callbacks(access.get(), &calls);
  H5Pset_file_image(access.get(), content.in_memory.bytes.get(), content.header.file_bytes);
  const std::string name = hdf5::memory_name(content.in_memory.bytes.get());
  return {H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

hdf5::Handle open_disk(const std::string& path, const InputFile& file) {
  const hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_sec2(access.get());
  // Files are replaced, never changed, so no lock is needed; some network file systems have none.
  H5Pset_file_locking(access.get(), false, true);
  const std::string same_file = fmt::format("/proc/self/fd/{}", file.descriptor());
  hdf5::Handle opened(H5Fopen(same_file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (!opened) opened = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  return opened;
}

}  // namespace

VerifiedFile verify_file(const std::string& source, const std::string& expected_kind, FormatVersions versions,
                         const Job& job) {
  VerifiedFile content;
  auto file = std::make_unique<InputFile>(source, job);
  const std::string path = name_for_messages(source);
  std::array<char, kHeader_bytes> block = {};
  const auto start = std::span(block).first(file->read(std::as_writable_bytes(std::span(block))));
  content.header = parse_header(path, start, expected_kind, versions);

  const std::uint64_t expected_bytes = content.header.file_bytes;
  BodyHash hash;
  if (const auto size = file->size_bytes()) {
    check_length(path, *size, expected_bytes);
    check_length(path, hash_from_disk(*file, hash), expected_bytes);
    content.on_disk = std::move(file);
  } else {
    check_length(path, hash_into_memory(*file, start, expected_bytes, content.in_memory, hash),
                 expected_bytes);
  }
  if (hash.hex() != content.header.body_hash) {
    throw IoError(path, "is altered or damaged: its content does not match its checksum");
  }
  return content;
}

hdf5::Handle open_verified(const std::string& path, VerifiedFile& content) {
  hdf5::Handle file = content.on_disk ? open_disk(path, *content.on_disk) : open_memory(content);
  content.on_disk.reset();
  if (!file) throw IoError(name_for_messages(path), "cannot be opened" + hdf5::reason());
  return file;
}

}  // namespace dim
