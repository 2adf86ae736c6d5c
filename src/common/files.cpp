#include "common/files.hpp"

#include <filesystem>

#include "base/atomic_file.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

bool is_special(const std::string& path) {
  std::error_code error;
  return path == "-" || (fs::exists(path, error) && !fs::is_regular_file(path, error));
}

// The file may not exist yet; where even its folder does not, the path as it is written.
fs::path whole_path(const std::string& path) {
  std::error_code error;
  auto whole = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::path(path) : whole;
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty() || is_special(a) || is_special(b)) return false;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return whole_path(a) == whole_path(b);
}

void refuse_unwritable(const std::string& path) {
  std::error_code error;
  if (is_special(path) && !fs::is_directory(path, error)) return;
  const AtomicFile probe(path);
}

}  // namespace dim
