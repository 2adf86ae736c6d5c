#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace dim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestCall_bytes = std::size_t{32} << 20;  // the stop flag is looked at between calls
constexpr std::size_t kLongestNameKept =
    200;  // leaves room for the temporary's own parts below NAME_MAX = 255
constexpr int kPipe_bytes = 1 << 20;
constexpr int kMaxLinks = 40;
constexpr int kMaxNamesTried = 1000;
constexpr mode_t kPermissionBits = 0777;

std::string words(int error) { return std::generic_category().message(error); }

std::string folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Where a path that does not exist leads: itself, or the missing target of a symbolic link.
std::string behind_links(const std::string& path) {
  fs::path at = path;
  for (int i = 0; i < kMaxLinks; ++i) {
    std::error_code error;
    const fs::path next = fs::read_symlink(at, error);
    if (error) return at.string();
    at = at.parent_path() / next;
  }
  throw IoError(path, "cannot write: " + words(ELOOP));
}

std::string temporary_name(const std::string& target, int attempt) {
  const fs::path path(target);
  std::string name = path.filename().string();
  if (name.size() > kLongestNameKept) name = "dim";
  return (path.parent_path() / fmt::format(".{}.{}-{}.tmp", name, ::getpid(), attempt)).string();
}

/// The process that a temporary of this target belongs to: `.NAME.PID-N.tmp`; 0 for any other file.
pid_t owner_of(const std::string& file, const std::string& target) {
  const std::string prefix = "." + target + ".", suffix = ".tmp";
  if (!file.starts_with(prefix) || !file.ends_with(suffix)) return 0;
  const char *at = file.data() + prefix.size(), *end = file.data() + file.size() - suffix.size();
  pid_t pid = 0;
  const auto number = std::from_chars(at, end, pid);
  int attempt = 0;
  if (number.ec != std::errc{} || number.ptr == end || *number.ptr != '-') return 0;
  return std::from_chars(number.ptr + 1, end, attempt).ptr == end && pid > 0 ? pid : 0;
}

/// Removes what runs that were killed (kill -9, power) have left of this target: their process is gone, and they are a
/// minute older than `now`, so that the process is not one of another machine that has only begun.
void sweep(const std::string& target, time_t now) {
  constexpr time_t kOld_s = 60;
  std::error_code error;
  const std::string name = fs::path(target).filename().string();
  for (fs::directory_iterator at(folder_of(target), error), end; !error && at != end; at.increment(error)) {
    const pid_t owner = owner_of(at->path().filename().string(), name);
    if (owner == 0 || ::kill(owner, 0) == 0 || errno != ESRCH) continue;
    struct stat left = {};
    if (::stat(at->path().c_str(), &left) == 0 && now - left.st_mtime > kOld_s) ::unlink(at->path().c_str());
  }
}

/// 0, or the error. Some file systems have nothing to sync and say so.
int sync(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS) return 0;
  return errno;
}

/// Makes a rename durable. A folder that may not be opened is left to the system.
int sync_folder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  const int error = sync(descriptor);
  ::close(descriptor);
  return error;
}

}  // namespace

AtomicFile::AtomicFile(std::string path, const Job& job) : path_(std::move(path)), stop_(job.stop) {
  if (path_.empty()) throw IoError("''", "cannot write: the file name is empty");
  struct stat existing = {};
  if (path_ == "-") {
    open_direct();
  } else if (::stat(path_.c_str(), &existing) == 0) {
    if (S_ISDIR(existing.st_mode)) throw IoError(path_, "cannot write: is a directory");
    std::error_code no_name;
    target_ = S_ISREG(existing.st_mode) ? fs::canonical(path_, no_name).string() : "";
    // No name: a deleted file, reached through /dev/fd.
    if (target_.empty() || no_name) {
      open_direct();
      return;
    }
    if (::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
    open_temporary(existing.st_mode & kPermissionBits);
    take_after(existing);
  } else if (errno == ENOENT) {
    target_ = behind_links(path_);
    if (!fs::path(target_).has_filename()) throw IoError(path_, "cannot write: is the name of a directory");
    open_temporary(std::nullopt);
  } else {
    fail(errno);
  }
}

AtomicFile::~AtomicFile() { abandon(); }

void AtomicFile::open_direct() {
  // A copy of descriptor 1, so that every descriptor held here is closed alike.
  do {
    // A fifo waits here for its reader.
    if (stop_ && stop_->load(std::memory_order_relaxed)) throw Interrupted();
    descriptor_ = path_ == "-" ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                               : ::open(path_.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) fail(errno);
  // A wider pipe saves most of the switching between two programs; refused for anything but a pipe.
  ::fcntl(descriptor_, F_SETPIPE_SZ, kPipe_bytes);
}

void AtomicFile::open_temporary(std::optional<mode_t> permissions) {
  // Nobody may read the temporary who may not read the file; without a file the umask decides.
  const mode_t mode = permissions.value_or(0666) & 0666;
  for (int attempt = 0; attempt < kMaxNamesTried; ++attempt) {
    temporary_ = temporary_name(target_, attempt);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ >= 0) {
      struct stat own = {};
      if (::fstat(descriptor_, &own) == 0) sweep(target_, own.st_mtime);
      return;
    }
    if (errno != EEXIST) break;
  }
  const int error = errno;
  temporary_.clear();
  const std::string folder = folder_of(target_);
  if (error == ENOENT) throw IoError(path_, "cannot write: there is no folder '" + folder + "'");
  throw IoError(path_, "cannot write in folder '" + folder + "': " + words(error));
}

/// Owner and permissions, as far as the user may and the file system can; the temporary began with no more.
void AtomicFile::take_after(const struct stat& existing) noexcept {
  [[maybe_unused]] int refused = ::fchown(descriptor_, existing.st_uid, existing.st_gid);
  refused = ::fchmod(descriptor_, existing.st_mode & kPermissionBits);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (descriptor_ < 0) throw InternalError(path_ + ": written after its end");
  while (!bytes.empty()) {
    if (stop_ && stop_->load(std::memory_order_relaxed)) throw Interrupted();
    const ssize_t n = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kLargestCall_bytes));
    if (n >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      pollfd waiting = {descriptor_, POLLOUT, 0};
      ::poll(&waiting, 1, -1);
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void AtomicFile::commit() {
  if (descriptor_ < 0) throw InternalError(path_ + ": written after its end");
  if (!temporary_.empty()) {
    if (const int error = sync(descriptor_); error != 0) fail(error);
  }
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  if (const int error = sync_folder(folder_of(target_)); error != 0) fail(error);
}

void AtomicFile::abandon() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(int error) {
  abandon();
  throw IoError(path_ == "-" ? "standard output" : path_, "cannot write: " + words(error));
}

void write_file(const std::string& path, std::span<const std::span<const std::byte>> parts, const Job& job) {
  AtomicFile file(path, job);
  for (const auto& part : parts) file.write(part);
  file.commit();
}

void write_file(const std::string& path, std::string_view text, const Job& job) {
  AtomicFile file(path, job);
  file.write(text);
  file.commit();
}

}  // namespace dim
