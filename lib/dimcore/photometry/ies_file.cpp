#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "photometry/ies.hpp"

namespace dim {
namespace {

std::string errno_text() { return std::strerror(errno); }

std::string read_bytes(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) throw IoError(path, "is a directory");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw IoError(path, "cannot open: " + errno_text());
  std::string bytes;
  // One byte more than allowed is enough to refuse the rest; a pipe has no size to ask for.
  std::string chunk(std::size_t{64} << 10, '\0');
  while (in && bytes.size() <= kMaxPhotometryBytes) {
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    bytes.append(chunk, 0, static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw IoError(path, "cannot read: " + errno_text());
  return bytes;
}

}  // namespace

Photometry read_ies_file(const std::string& path, Warnings& warnings) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const auto beside = [&](const std::string& name) {
    return read_bytes((folder / std::filesystem::path(name).filename()).string());
  };
  return read_ies(read_bytes(path), path, warnings, beside);
}

}  // namespace dim
