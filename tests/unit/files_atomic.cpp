#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/atomic_file.hpp"
#include "catch.hpp"
#include "files_support.hpp"

using dim::AtomicFile;
using dim::write_file;
using files_test::contents;
using files_test::Folder;
using files_test::io_error;
using files_test::put;
using files_test::start_child;
using files_test::wait_for;

namespace {

unsigned permissions(const std::string& path) {
  struct stat status = {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 07777U;
}

constexpr int kNobody = 65534;

}  // namespace

TEST_CASE("Parts of a file arrive in order and no temporary stays", "[base][unit]") {
  const Folder folder;
  const std::string one = "one, ";
  const std::string two(3 << 20, '2');
  const std::array parts = {std::as_bytes(std::span(one)), std::as_bytes(std::span(two))};
  write_file(folder / "übung 1.bin", parts);
  CHECK(contents(folder / "übung 1.bin") == one + two);
  write_file(folder / "empty", "");
  CHECK(contents(folder / "empty").empty());
  CHECK(folder.n_files() == 2);
}

TEST_CASE("What killed runs left of a file is swept, of others and of running ones it is not", "[base][unit]") {
  const Folder folder;
  const pid_t gone = start_child([] {});
  REQUIRE(wait_for(gone) == 0);
  const auto leave = [&](const std::string& name, int age_s) {
    put(folder / name, "part");
    const timespec then{::time(nullptr) - age_s, 0}, times[2] = {then, then};
    REQUIRE(::utimensat(AT_FDCWD, (folder / name).c_str(), times, 0) == 0);
  };
  const std::string pid = std::to_string(gone), own = std::to_string(::getpid());
  leave(".a." + pid + "-0.tmp", 120);
  leave(".a." + pid + "-1.tmp", 10);    // may be another machine's
  leave(".a." + own + "-7.tmp", 120);   // still being written
  leave(".b." + pid + "-0.tmp", 120);   // another file's
  leave(".a." + pid + "x-0.tmp", 120);  // no name of ours
  write_file(folder / "a", "new");
  CHECK(folder.n_files() == 5);
  CHECK(::access((folder / (".a." + pid + "-0.tmp")).c_str(), F_OK) != 0);
}

TEST_CASE("Without a commit the previous file stays and the temporary goes", "[base][unit]") {
  const Folder folder;
  put(folder / "a", "old");
  {
    AtomicFile file(folder / "a");
    file.write("new");
    CHECK(folder.n_files() == 2);
    CHECK(contents(folder / "a") == "old");
  }
  CHECK(contents(folder / "a") == "old");
  CHECK(folder.n_files() == 1);
}

TEST_CASE("A stop flag ends the writing and leaves nothing behind", "[base][unit]") {
  const Folder folder;
  std::atomic<bool> stop = false;
  dim::Job job;
  job.stop = &stop;
  const auto interrupted = [&] {
    AtomicFile file(folder / "a", job);
    file.write("one");
    stop = true;
    file.write("two");
  };
  CHECK_THROWS_AS(interrupted(), dim::Interrupted);
  CHECK(folder.n_files() == 0);
}

TEST_CASE("An existing file keeps its permission bits, a new one follows the umask", "[base][unit]") {
  const Folder folder;
  for (const unsigned mode : {0600U, 0640U, 0755U}) {
    put(folder / "a", "old");
    ::chmod((folder / "a").c_str(), mode);
    write_file(folder / "a", "new");
    CHECK(permissions(folder / "a") == mode);
    CHECK(contents(folder / "a") == "new");
  }
  const mode_t before = ::umask(027);
  write_file(folder / "b", "new");
  ::umask(before);
  CHECK(permissions(folder / "b") == 0640U);
}

TEST_CASE("A symbolic link stays and what it names is written", "[base][unit]") {
  const Folder folder;
  std::filesystem::create_directory(folder / "real");
  put(folder / "real/a", "old");
  std::filesystem::create_symlink("real/a", folder / "link");
  std::filesystem::create_symlink("real/missing", folder / "dangling");
  write_file(folder / "link", "new");
  write_file(folder / "dangling", "made");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(std::filesystem::is_symlink(folder / "dangling"));
  CHECK(contents(folder / "real/a") == "new");
  CHECK(contents(folder / "real/missing") == "made");

  std::filesystem::create_symlink("loop", folder / "loop");
  CHECK_THAT(io_error([&] { write_file(folder / "loop", ""); }), Catch::Matchers::Contains("symbolic links"));
}

TEST_CASE("A place that cannot be written is refused in words before any work", "[base][unit]") {
  const Folder folder;
  const auto refusal = [](const std::string& path) { return io_error([&] { const AtomicFile file(path); }); };
  CHECK(refusal(folder.str()) == folder.str() + ": cannot write: is a directory");
  CHECK(refusal(folder / "new/") == (folder / "new/") + ": cannot write: is the name of a directory");
  CHECK(refusal(folder / "no/a") ==
        (folder / "no/a") + ": cannot write: there is no folder '" + (folder / "no") + "'");
  put(folder / "file", "");
  CHECK(refusal(folder / "file/a") == (folder / "file/a") + ": cannot write: Not a directory");
  CHECK_FALSE(refusal("").empty());
}

TEST_CASE("A name as long as the file system allows is written", "[base][unit]") {
  const Folder folder;
  const std::string name(255, 'n');
  write_file(folder / name, "new");
  CHECK(contents(folder / name) == "new");
  CHECK_THAT(io_error([&] { write_file(folder / (name + "n"), ""); }),
             Catch::Matchers::Contains("File name too long"));
  CHECK(folder.n_files() == 1);
}

TEST_CASE("A write-protected file and folder are refused", "[base][unit]") {
  const Folder folder;
  put(folder / "a", "old");
  ::chmod((folder / "a").c_str(), 0444);
  ::chmod(folder.str().c_str(), 0777);
  std::filesystem::create_directory(folder / "closed");
  ::chmod((folder / "closed").c_str(), 0555);
  const auto child = start_child([&] {
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return;
    const auto denied = [](const std::string& message) {
      return message.find("Permission denied") != std::string::npos;
    };
    const bool file_denied = denied(io_error([&] { write_file(folder / "a", "new"); }));
    const bool folder_denied = denied(io_error([&] { write_file(folder / "closed/a", "new"); }));
    if (!file_denied || !folder_denied) ::_exit(2);
  });
  CHECK(wait_for(child) == 0);
  CHECK(contents(folder / "a") == "old");
}

TEST_CASE("Devices are written directly, a full one says so", "[base][unit]") {
  write_file("/dev/null", "gone");
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK(io_error([] { write_file("/dev/full", "x"); }) == "/dev/full: cannot write: No space left on device");
}

TEST_CASE("A fifo is written directly", "[base][unit]") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  const std::string data(5 << 20, 'x');
  const auto child = start_child([&] { write_file(folder / "fifo", data); });
  CHECK(contents(folder / "fifo") == data);
  CHECK(wait_for(child) == 0);
  CHECK(std::filesystem::is_fifo(folder / "fifo"));
}

TEST_CASE("A dash is standard output, also when the pipe takes no more for a while", "[base][unit]") {
  files_test::Pipe pipe;
  const std::string data(5 << 20, 'x');
  const auto child = start_child([&] {
    pipe.close_reader();
    ::fcntl(pipe.writer(), F_SETFL, O_NONBLOCK);
    const files_test::Redirected out(STDOUT_FILENO, pipe.writer());
    write_file("-", data);
  });
  pipe.close_writer();
  const std::string received = contents(files_test::name_of(pipe.reader()));
  CHECK(wait_for(child) == 0);
  CHECK(received == data);
}

TEST_CASE("A closed pipe is an error where SIGPIPE is ignored", "[base][unit]") {
  files_test::Pipe pipe;
  pipe.close_reader();
  const auto child = start_child([&] {
    std::signal(SIGPIPE, SIG_IGN);
    const files_test::Redirected out(STDOUT_FILENO, pipe.writer());
    if (io_error([] { write_file("-", "x"); }) != "standard output: cannot write: Broken pipe") ::_exit(2);
  });
  CHECK(wait_for(child) == 0);
}

TEST_CASE("A write that fails half-way leaves the previous file and no temporary", "[base][unit]") {
  const Folder folder;
  put(folder / "a", "old");
  const auto child = start_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {1 << 20, 1 << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string data(3 << 20, 'x');
    const auto expected = (folder / "a") + ": cannot write: File too large";
    if (io_error([&] { write_file(folder / "a", data); }) != expected) ::_exit(2);
  });
  CHECK(wait_for(child) == 0);
  CHECK(contents(folder / "a") == "old");
  CHECK(folder.n_files() == 1);
}

TEST_CASE("Kill -9 during a write leaves the previous file whole", "[base][unit]") {
  const Folder folder;
  put(folder / "a", "old");
  const auto child = start_child([&] {
    const std::string data(1 << 20, 'x');
    AtomicFile file(folder / "a");
    for (int i = 0; i < 64; ++i) file.write(data);
    for (;;) ::pause();
  });
  // The second file is the temporary; give it time to grow.
  for (int i = 0; i < 1000 && folder.n_files() < 2; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, SIGKILL);
  CHECK(wait_for(child) == -SIGKILL);
  CHECK(contents(folder / "a") == "old");
  CHECK(folder.n_files() == 2);
  write_file(folder / "a", "new");
  CHECK(contents(folder / "a") == "new");
}
