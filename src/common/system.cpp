#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "common/program.hpp"

namespace dim {

std::size_t peak_memory_bytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void keep_freed_memory() {
  constexpr int kMostKept = std::numeric_limits<int>::max();
  mallopt(M_MMAP_THRESHOLD, kMostKept);
  mallopt(M_TRIM_THRESHOLD, kMostKept);
}

namespace {

// First number of a file, or nothing where it says "max" or is not there.
std::optional<std::size_t> number_in(const std::string& path) {
  std::ifstream file(path);
  std::size_t value = 0;
  if (file >> value) return value;
  return {};
}

// What this process maps now, bytes.
std::size_t mapped_bytes() {
  return number_in("/proc/self/statm").value_or(0) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t difference(std::size_t a, std::size_t b) { return a > b ? a - b : 0; }

// What a container leaves of its memory, version 2 of control groups, then 1.
std::size_t group_memory_bytes() {
  for (const auto& [limit, used] : {std::pair{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
                                    std::pair{"/sys/fs/cgroup/memory/memory.limit_in_bytes",
                                              "/sys/fs/cgroup/memory/memory.usage_in_bytes"}}) {
    if (const auto most = number_in(limit)) return difference(*most, number_in(used).value_or(0));
  }
  return std::numeric_limits<std::size_t>::max();
}

}  // namespace

std::size_t free_memory_bytes() {
  std::size_t available = group_memory_bytes();
  std::ifstream meminfo("/proc/meminfo");
  std::string key, unit;
  std::size_t kibibytes = 0;
  while (meminfo >> key >> kibibytes && std::getline(meminfo, unit)) {
    if (key == "MemAvailable:") available = std::min(available, kibibytes * 1024);
  }
  // An address-space limit (ulimit -v) binds earlier than the machine's memory.
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    available = std::min(available, difference(limit.rlim_cur, mapped_bytes()));
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
