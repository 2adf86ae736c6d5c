#include "database/entry_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace dim {

namespace fs = std::filesystem;

EntryStore::EntryStore(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw IoError(folder_, "cannot make the folder: " + error.message());
  lock_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw IoError(folder_, std::strerror(errno));
  while (flock(lock_, LOCK_EX) != 0) {
    if (errno == EINTR) continue;
    const int failure = errno;
    close(lock_);
    throw IoError(folder_, std::string("cannot lock: ") + std::strerror(failure));
  }
}

EntryStore::~EntryStore() { close(lock_); }

std::string EntryStore::path_of(const std::string& name) const { return (fs::path(folder_) / name).string(); }

std::optional<std::string> EntryStore::add(const std::vector<StoredFile>& files, bool replace) {
  std::error_code error;
  if (!replace)
    for (const auto& file : files)
      if (fs::exists(fs::symlink_status(path_of(file.name), error))) return file.name;
  std::vector<std::string> written;
  try {
    for (const auto& file : files) {
      const bool was_there = fs::exists(path_of(file.name), error);
      write_file(path_of(file.name), file.bytes);
      if (!was_there) written.push_back(file.name);
    }
  } catch (const Error&) {
    for (const auto& name : written) fs::remove(path_of(name), error);
    throw;
  }
  return std::nullopt;
}

void EntryStore::remove(const std::vector<std::string>& names) {
  for (const auto& name : names) {
    std::error_code error;
    fs::remove(path_of(name), error);
    if (error) throw IoError(path_of(name), "cannot remove: " + error.message());
  }
}

}  // namespace dim
