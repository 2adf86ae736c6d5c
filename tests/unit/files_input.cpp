#include <sys/stat.h>

#include <array>
#include <atomic>
#include <thread>

#include "base/input_file.hpp"
#include "catch.hpp"
#include "files_support.hpp"

using dim::read_text_file;
using files_test::Folder;
using files_test::io_error;
using files_test::put;
using files_test::start_child;
using files_test::wait_for;

namespace {

constexpr std::size_t kCap = 1 << 20;

std::string refusal(const std::string& path, std::size_t max_bytes = kCap) {
  return io_error([&] { read_text_file(path, max_bytes); });
}

/// What a reader of standard input gets when `data` comes down a pipe.
std::string read_from_pipe(const std::string& data, std::size_t max_bytes) {
  files_test::Pipe pipe;
  const auto child = start_child([&] {
    std::signal(SIGPIPE, SIG_IGN);
    pipe.close_reader();
    [[maybe_unused]] const auto n = ::write(pipe.writer(), data.data(), data.size());
  });
  pipe.close_writer();
  std::string result;
  {
    const files_test::Redirected in(STDIN_FILENO, pipe.reader());
    pipe.close_reader();
    std::string text;
    const std::string error = io_error([&] { text = read_text_file("-", max_bytes); });
    result = error.empty() ? text : error;
  }
  wait_for(child);
  return result;
}

}  // namespace

TEST_CASE("A text file is read byte for byte", "[base][unit]") {
  const Folder folder;
  for (const std::string& text :
       {std::string(), std::string("a\r\n\0\xff z", 7), std::string(300'000, 'x')}) {
    put(folder / "a", text);
    CHECK(read_text_file(folder / "a", kCap) == text);
  }
}

TEST_CASE("A file of exactly the largest size is read, one byte more is refused", "[base][unit]") {
  const Folder folder;
  put(folder / "a", std::string(1000, 'x'));
  CHECK(read_text_file(folder / "a", 1000).size() == 1000);
  CHECK(refusal(folder / "a", 999) == (folder / "a") + ": is 1000 bytes; at most 999 bytes");

  std::filesystem::resize_file(folder / "a", kCap + 1);
  CHECK(refusal(folder / "a") == (folder / "a") + ": is 1048577 bytes; at most 1048576");
  std::filesystem::resize_file(folder / "a", 1'181'116'006);
  CHECK(refusal(folder / "a", 64 * kCap) == (folder / "a") + ": is 1.1 GiB; at most 64 MiB");
}

TEST_CASE("Standard input is read to its end under the same limit", "[base][unit]") {
  CHECK(read_from_pipe("", kCap).empty());
  CHECK(read_from_pipe("short", kCap) == "short");
  const std::string text(kCap, 'x');
  CHECK(read_from_pipe(text, kCap) == text);
  CHECK(read_from_pipe(text + "x", kCap) == "standard input: is more than 1 MiB, the most that is accepted");
}

TEST_CASE("A file whose size the system does not know is read whole", "[base][unit]") {
  CHECK_THAT(read_text_file("/proc/self/status", kCap), Catch::Matchers::Contains("Pid:"));
  CHECK(refusal("/dev/zero") == "/dev/zero: is more than 1 MiB, the most that is accepted");
  CHECK(read_text_file("/dev/null", kCap).empty());
}

TEST_CASE("What cannot be read is refused in the system's words", "[base][unit]") {
  const Folder folder;
  CHECK(refusal(folder / "no") == (folder / "no") + ": cannot read: No such file or directory");
  CHECK(refusal(folder.str()) == folder.str() + ": is a directory");
  CHECK(refusal("") == ": cannot read: No such file or directory");

  put(folder / "closed", "secret");
  ::chmod((folder / "closed").c_str(), 0);
  ::chmod(folder.str().c_str(), 0755);
  const auto child = start_child([&] {
    if (::geteuid() == 0 && ::setuid(65534) != 0) return;
    if (refusal(folder / "closed") != (folder / "closed") + ": cannot read: Permission denied") ::_exit(2);
  });
  CHECK(wait_for(child) == 0);
}

TEST_CASE("A closed standard input is an error, not an empty file", "[base][unit]") {
  const auto child = start_child([] {
    ::close(STDIN_FILENO);
    if (refusal("-") != "standard input: cannot read: Bad file descriptor") ::_exit(2);
  });
  CHECK(wait_for(child) == 0);
}

TEST_CASE("A stop flag and a signal end the wait for a silent pipe", "[base][unit]") {
  files_test::Pipe pipe;
  const auto child = start_child([&] {
    static std::atomic<bool> stop = false;
    struct sigaction action = {};
    action.sa_handler = [](int) { stop = true; };
    ::sigaction(SIGALRM, &action, nullptr);
    // Again and again, for one that comes just before the wait would not end it.
    ::ualarm(20'000, 20'000);
    const files_test::Redirected in(STDIN_FILENO, pipe.reader());
    dim::Job job;
    job.stop = &stop;
    try {
      read_text_file("-", kCap, job);
    } catch (const dim::Interrupted&) {
      ::_exit(7);
    }
  });
  CHECK(wait_for(child) == 7);
}

TEST_CASE("Sizes are told in words", "[base][unit]") {
  CHECK(dim::size_in_words(0) == "0 bytes");
  CHECK(dim::size_in_words(1) == "1 byte");
  CHECK(dim::size_in_words(1023) == "1023 bytes");
  CHECK(dim::size_in_words(1536) == "1.5 KiB");
  CHECK(dim::size_in_words((1 << 20) - 1) == "1 MiB");
  CHECK(dim::size_in_words(64 << 20) == "64 MiB");
  CHECK(dim::size_in_words(~std::uint64_t{0}) == "16 EiB");
}
