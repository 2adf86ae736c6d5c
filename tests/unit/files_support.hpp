#pragma once

// For the tests of files: a folder of their own, whole files as strings, and children that fail in peace.

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace files_test {

/// A new folder, removed with everything in it at the end of the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "dim-files-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string str() const { return path_.string(); }
  std::size_t n_files() const {
    const std::filesystem::directory_iterator files(path_);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

 private:
  std::filesystem::path path_;
};

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// The message of the IoError that `call` throws; empty if it throws none.
template <class Call>
std::string io_error(Call&& call) {
  try {
    call();
  } catch (const dim::IoError& error) {
    return error.what();
  }
  return "";
}

/// Starts `call` in a child process that ends with status 0, or 1 when it throws.
template <class Call>
pid_t start_child(Call&& call) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  int status = 0;
  try {
    call();
  } catch (...) {
    status = 1;
  }
  ::_exit(status);
}

/// Exit status of the child, or minus the signal that ended it.
inline int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// A pipe whose ends are closed with it.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe(ends) != 0) throw dim::InternalError("no pipe");
  }
  ~Pipe() {
    close_reader();
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_reader() { close_end(0); }
  void close_writer() { close_end(1); }
  int reader() const { return ends[0]; }
  int writer() const { return ends[1]; }

 private:
  void close_end(int i) {
    if (ends[i] >= 0) ::close(ends[i]);
    ends[i] = -1;
  }
};

/// Puts another descriptor in the place of standard input or output for the life of the object.
class Redirected {
 public:
  Redirected(int standard, int to) : standard_(standard), kept_(::dup(standard)) { ::dup2(to, standard_); }
  ~Redirected() {
    ::dup2(kept_, standard_);
    ::close(kept_);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;

 private:
  int standard_;
  int kept_;
};

/// A fifo or pipe descriptor's name, so that it can be opened like a file.
inline std::string name_of(int descriptor) { return "/dev/fd/" + std::to_string(descriptor); }

}  // namespace files_test
