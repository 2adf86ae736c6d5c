#include "database/entry_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/error.hpp"

namespace dim {

std::string read_entry_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path, std::strerror(errno));
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace dim
