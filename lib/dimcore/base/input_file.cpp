#include "base/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace dim {
namespace {

std::string name_for_messages(const std::string& path) { return path == "-" ? "standard input" : path; }

constexpr std::size_t kFirstRead_bytes = std::size_t{64} << 10;
constexpr std::size_t kLargestCall_bytes = std::size_t{32} << 20;  // the stop flag is looked at between calls
constexpr int kPipe_bytes = 1 << 20;

[[noreturn]] void throw_unreadable(const std::string& path, int error) {
  throw IoError(name_for_messages(path), "cannot read: " + std::generic_category().message(error));
}

std::string too_large(std::uint64_t n_bytes, bool is_all, std::size_t max_bytes) {
  if (!is_all) return "is more than " + size_in_words(max_bytes) + ", the most that is accepted";
  const std::string found = size_in_words(n_bytes);
  const std::string limit = size_in_words(max_bytes);
  if (found == limit) return fmt::format("is {} bytes; at most {}", n_bytes, max_bytes);
  return "is " + found + "; at most " + limit;
}

}  // namespace

InputFile::InputFile(std::string path, const Job& job) : path_(std::move(path)), stop_(job.stop) {
  const bool is_stdin = path_ == "-";
  // A copy of descriptor 0, so that every descriptor held here is closed alike.
  do {
    // A fifo waits here for its writer.
    if (stop_ && stop_->load(std::memory_order_relaxed)) throw Interrupted();
    descriptor_ =
        is_stdin ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) throw_unreadable(path_, errno);
  struct stat status = {};
  const int error = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  if (error != 0 || S_ISDIR(status.st_mode)) {
    ::close(descriptor_);
    if (error != 0) throw_unreadable(path_, error);
    throw IoError(name_for_messages(path_), "is a directory");
  }
  if (S_ISREG(status.st_mode) && !is_stdin) size_bytes_ = static_cast<std::uint64_t>(status.st_size);
  // A wider pipe saves most of the switching between two programs; a refusal does no harm.
  if (S_ISFIFO(status.st_mode)) ::fcntl(descriptor_, F_SETPIPE_SZ, kPipe_bytes);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read(std::span<std::byte> out) {
  std::size_t n_read = 0;
  while (n_read < out.size()) {
    if (stop_ && stop_->load(std::memory_order_relaxed)) throw Interrupted();
    const std::size_t n_asked = std::min(out.size() - n_read, kLargestCall_bytes);
    const ssize_t n = ::read(descriptor_, out.data() + n_read, n_asked);
    if (n == 0) break;
    if (n > 0) {
      n_read += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN) {
      pollfd waiting = {descriptor_, POLLIN, 0};
      ::poll(&waiting, 1, -1);
    } else if (errno != EINTR) {
      throw_unreadable(path_, errno);
    }
  }
  return n_read;
}

std::string read_text_file(const std::string& path, std::size_t max_bytes, const Job& job) {
  InputFile file(path, job);
  const std::uint64_t expected_bytes = file.size_bytes().value_or(0);
  if (expected_bytes > max_bytes)
    throw IoError(name_for_messages(path), too_large(expected_bytes, true, max_bytes));

  // One byte more than expected, so that the end is seen without another allocation. The size is only a first
  // guess: files of /proc say 0, and a file may grow meanwhile.
  std::string text;
  std::size_t room_bytes =
      expected_bytes > 0 ? static_cast<std::size_t>(expected_bytes) + 1 : kFirstRead_bytes;
  for (;;) {
    const std::size_t n_before = text.size();
    text.resize(n_before + room_bytes);
    const std::size_t n = file.read(std::as_writable_bytes(std::span(text).subspan(n_before)));
    text.resize(n_before + n);
    if (text.size() > max_bytes)
      throw IoError(name_for_messages(path), too_large(text.size(), false, max_bytes));
    if (n < room_bytes) break;
    room_bytes = std::min(text.size(), max_bytes - text.size() + 1);
  }
  if (text.capacity() / 2 > text.size()) text.shrink_to_fit();
  return text;
}

std::string size_in_words(std::uint64_t n_bytes) {
  constexpr std::array kUnits = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  if (n_bytes < 1024) return fmt::format("{} byte{}", n_bytes, n_bytes == 1 ? "" : "s");
  double value = static_cast<double>(n_bytes) / 1024.0;
  std::size_t unit = 0;
  while (value >= 1023.95 && unit + 1 < kUnits.size()) {
    value /= 1024.0;
    ++unit;
  }
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text + ' ' + kUnits.at(unit);
}

}  // namespace dim
