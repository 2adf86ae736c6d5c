#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "common/program.hpp"

namespace dim {

std::size_t peak_memory_bytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

std::size_t free_memory_bytes() {
  std::size_t available = std::numeric_limits<std::size_t>::max();
  std::ifstream meminfo("/proc/meminfo");
  std::string key, unit;
  std::size_t kibibytes = 0;
  while (meminfo >> key >> kibibytes && std::getline(meminfo, unit)) {
    if (key == "MemAvailable:") available = kibibytes * 1024;
  }
  // An address-space limit (ulimit -v) binds earlier than the machine's memory.
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    available = std::min<std::size_t>(available, limit.rlim_cur);
  return available;
}

void refuse_terminal(const std::string& path, const std::string& what) {
  if (path == "-" && isatty(STDOUT_FILENO))
    throw UsageError("will not write " + what + " to a terminal; give a file name with -o or use a pipe");
}

std::string executable_folder() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "." : path.parent_path().string();
}

}  // namespace dim
